"""Notebook hygiene: what the stored form of a notebook may and may not contain.

python -m book.tools.notebooks execute NOTEBOOK ...   run them and store their outputs, cleanly
python -m book.tools.notebooks clean NOTEBOOK ...     take out what does not belong there
python -m book.tools.notebooks check NOTEBOOK ...     say what is wrong; exit status 1 if anything is
"""

from __future__ import annotations

import argparse
import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from book.tools import reading
from book.tools.captions import CaptionError, numbered
from rosmini.viz.embed import BOOK, LIVE, VARIABLE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import nbformat

CELL_TIMEOUT_S = 300

KERNELSPEC = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
# Complete, since nbconvert takes the ending of a script from it, and with no version, which differs between machines.
LANGUAGE = {
    "file_extension": ".py",
    "mimetype": "text/x-python",
    "name": "python",
    "nbconvert_exporter": "python",
    "pygments_lexer": "ipython3",
}
CELL_METADATA = {"tags", "mystnb", "jupyter", "reason", "editable", "deletable", "alt"}
"""`alt` describes the cell's picture for those who cannot see it, where the picture's own text is too general."""

# Tags by which a cell asks not to be run or not to be compared. Each needs a reason.
EXEMPTIONS = {
    "nbval-skip",
    "nbval-ignore-output",
    "nbval-raises-exception",
    "raises-exception",
    "skip-execution",
    "remove-output",
    "remove-cell",
}
# nbval also reads them as comments.
EXEMPTION_COMMENT = re.compile(r"^\s*#\s*(NBVAL_\w+|PYTEST_VALIDATE_IGNORE_OUTPUT)\b[ :]*(.*)$", re.MULTILINE)
# JupyterLab takes the text between two dollar signs as a formula, except in a backtick fence at the start of a line.
MISREAD_FENCE = re.compile(r"^(?:\s*~~~|\s*>[\s>]*(?:```|~~~)).*$", re.MULTILINE)

REASON_COMMENT = re.compile(r"^\s*#\s*reason:\s*\S", re.MULTILINE | re.IGNORECASE)

# What makes an output differ between two runs or two machines.
UNSTABLE = {
    "a memory address": re.compile(r"\b0x[0-9a-f]{8,16}\b"),
    "a path of this machine": re.compile(
        r"(?<![\w./:])(?!/usr/bin/env\b)/(home|root|tmp|work|Users|usr|private|var|opt(?!/ros/noetic\b))/\w|\b[A-Z]:\\\w|ipykernel_\d+"
    ),
    "a local address": re.compile(r"127\.0\.0\.1"),
    "a warning with a path": re.compile(r"Warning: .*\n\s+warnings\.warn"),
}
# Calls whose output nbval cannot compare.
UNCOMPARABLE = re.compile(r"\b(clear_output|display_id\s*=|interactive\(|(?:widgets\.)?Output\(\))")


def read(path: Path) -> nbformat.NotebookNode:
    """The notebook at `path`, in format 4."""
    import nbformat

    notebook: nbformat.NotebookNode = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    return notebook


def write(notebook: nbformat.NotebookNode, path: Path) -> None:
    """Store `notebook` at `path`: the same notebook gives the same bytes."""
    import nbformat

    with path.open("w", encoding="utf-8", newline="\n") as file:
        nbformat.write(notebook, file)  # type: ignore[no-untyped-call]


def problems(notebook: nbformat.NotebookNode) -> Iterator[str]:
    """What is wrong with the stored form of `notebook`, one line each, naming the cell by its place (from 1)."""
    if notebook.metadata.get("kernelspec", {}).get("name") != "python3":
        yield "the notebook's kernel is not python3"
    extra = sorted(set(notebook.metadata) - {"kernelspec", "language_info"})
    if extra:
        yield f"the notebook's metadata has {', '.join(extra)}"
    if notebook.metadata.get("language_info") != LANGUAGE:
        yield "the notebook's language_info is not the one that `clean` stores"
    try:
        wrong = [text for text, right in zip(prose(notebook), numbered(prose(notebook)), strict=True) if text != right]
    except CaptionError as error:
        yield str(error)
    else:
        yield from (f"a number is wrong in {text[:60]!r}: `clean` writes the right one" for text in wrong)
    expected = 0
    for place, cell in enumerate(notebook.cells, start=1):
        found = list(cell_problems(cell))
        if cell.cell_type == "code" and cell.source.strip():
            expected += 1
            if cell.execution_count is None:
                found.append("was not executed")
            elif cell.execution_count != expected:
                found.append(f"was executed as number {cell.execution_count}, not {expected}: run all, from the top")
        yield from (f"cell {place} {problem}: {first_line(cell)!r}" for problem in found)


def prose(notebook: nbformat.NotebookNode) -> list[str]:
    """The sources of the Markdown cells, in reading order."""
    return [cell.source for cell in notebook.cells if cell.cell_type == "markdown"]


def cell_problems(cell: nbformat.NotebookNode) -> Iterator[str]:
    """What is wrong with one cell, apart from its execution count."""
    extra = sorted(set(cell.metadata) - CELL_METADATA)
    if extra:
        yield f"has metadata of a tool or a run ({', '.join(extra)})"
    if control := re.search(r"[\x00-\x08\x0b-\x1f]", cell.source):
        yield f"contains the control character {control[0]!r}: a backslash that a program has read as the start of one"
    if cell.cell_type != "code":
        if fence := MISREAD_FENCE.search(cell.source):
            yield (
                f"has the fence {fence[0].strip()!r}, which JupyterLab shows wrongly: write ``` at the start of the "
                "line, and <blockquote> for a box around it"
            )
        return
    if not cell.source.strip():
        yield "is empty"
    yield from exemption_problems(cell)
    if ("hide-input" in cell.metadata.get("tags", [])) != bool(cell.metadata.get("jupyter", {}).get("source_hidden")):
        yield "is folded in the book or in JupyterLab only: the tag hide-input and jupyter.source_hidden go together"
    uncomparable = UNCOMPARABLE.search(cell.source)
    if uncomparable:
        yield f"uses {uncomparable[1]}, whose output nbval cannot compare"
    if cell.source.rstrip().endswith(";") and not cell.source.startswith("%%"):
        yield "hides its value with a semicolon, which nbval does not see: assign it"
    for output in cell.outputs:
        yield from output_problems(output)


def exemption_problems(cell: nbformat.NotebookNode) -> Iterator[str]:
    """Exemptions from running or comparing that give no reason (metadata `reason`, or a comment `# reason: ...`)."""
    explained = bool(str(cell.metadata.get("reason", "")).strip()) or bool(REASON_COMMENT.search(cell.source))
    for tag in cell.metadata.get("tags", []):
        if tag.lower() in EXEMPTIONS and not explained:
            yield f"has the tag {tag} and gives no reason"
    for comment in EXEMPTION_COMMENT.finditer(cell.source):
        if not explained and not comment[2].strip():
            yield f"has the comment {comment[1]} and gives no reason"


def output_problems(output: nbformat.NotebookNode) -> Iterator[str]:
    """What in one output would differ elsewhere."""
    text = "\n".join(texts(output))
    for what, pattern in UNSTABLE.items():
        if found := pattern.search(text):
            yield f"printed {what} ({found[0].strip()!r})"
    if LIVE in text:
        yield "holds a moving picture in its live form: `execute` stores the small one that the book shows"
    if output.get("metadata", {}).get("needs_background"):
        yield "has an output with metadata of a plotting library"


def texts(output: nbformat.NotebookNode) -> Iterator[str]:
    """The textual parts of one output."""
    if output.output_type == "stream":
        yield output.text
    elif output.output_type == "error":
        yield from output.traceback
    else:
        for mime, data in output.data.items():
            if mime.startswith("text/") and isinstance(data, str):
                yield data


def first_line(cell: nbformat.NotebookNode) -> str:
    """How a cell begins, for messages."""
    lines = cell.source.strip().splitlines()
    return lines[0][:60] if lines else ""


def clean(notebook: nbformat.NotebookNode) -> None:
    """Give `notebook` the metadata of all notebooks, in place, without those of a run.

    Number its captions, and state the time that it takes.
    """
    texts = iter(numbered(prose(notebook)))
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = next(texts)
    reading.state_minutes(notebook)
    clean_metadata(notebook)


def clean_metadata(notebook: nbformat.NotebookNode) -> None:
    """Give `notebook` the metadata of all notebooks, in place, without those of a run."""
    notebook.metadata = type(notebook.metadata)(kernelspec=KERNELSPEC, language_info=LANGUAGE)
    for cell in notebook.cells:
        for key in set(cell.metadata) - CELL_METADATA:
            del cell.metadata[key]
        for output in cell.get("outputs", []):
            if output.get("metadata", {}).get("needs_background"):
                del output.metadata["needs_background"]


def before_save(model: dict[str, Any], **_: object) -> None:
    """Clean the metadata of a notebook that JupyterLab saves, so that git shows changes of its cells only.

    A hook of Jupyter's contents manager: `model` is what the page has sent, and is changed in place.
    """
    import nbformat

    if model["type"] == "notebook":
        notebook = nbformat.from_dict(model["content"])  # type: ignore[no-untyped-call]
        clean_metadata(notebook)
        model["content"] = notebook


def execute(notebook: nbformat.NotebookNode, folder: Path) -> None:
    """Run `notebook`, in place, in a new kernel in `folder`, with the display form of the book.

    Raises nbclient's `CellExecutionError` if a cell fails.
    """
    from nbclient import NotebookClient

    client = NotebookClient(
        notebook,
        timeout=CELL_TIMEOUT_S,
        kernel_name="python3",
        resources={"metadata": {"path": str(folder)}},
        record_timing=False,
        coalesce_streams=True,
    )
    client.execute(env=os.environ | {VARIABLE: BOOK})


def on_each(action: str, paths: Sequence[Path]) -> int:
    """Do `action` ("execute", "clean" or "check") on each notebook; how many problems were found."""
    count = 0
    for path in paths:
        notebook = read(path)
        if action == "execute":
            execute(notebook, path.parent)
        if action in {"execute", "clean"}:
            clean(notebook)
            write(notebook, path)
        for problem in problems(notebook):
            count += 1
            print(f"{path.as_posix()}: {problem}")
    return count


def main(argv: Sequence[str] | None = None) -> int:
    """The command line of this module; 1 if a notebook has problems."""
    summary, _, usage = str(__doc__).partition("\n")
    parser = argparse.ArgumentParser(
        prog="python -m book.tools.notebooks",
        description=summary,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("action", choices=["execute", "clean", "check"])
    parser.add_argument("notebooks", nargs="+", type=Path)
    args: Any = parser.parse_args(argv)
    return 1 if on_each(args.action, args.notebooks) else 0


if __name__ == "__main__":
    sys.exit(main())
