"""`rosmini assignment`: write a notebook with some exercises of the chapters, without their solutions."""

from __future__ import annotations

import argparse
import copy
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.book import checks
from rosmini.core.errors import RosminiError
from rosmini.tools.checkout import find_checkout

from . import notebooks as stored
from .solutions import checks as check_cells
from .solutions import stubs, without_solutions

if TYPE_CHECKING:
    import nbformat

START = "import rosmini\n\n%load_ext rosmini\n%roscore"
HEADING = re.compile(r"^### Exercise \d+", re.MULTILINE)
NOTE = """\
# Assignment

Each task is an exercise of *rosmini*, and its chapter explains what you need. A check that says `right` is worth one \
point. The checks use the seed {seed}: it determines the errors of wheels and sensors, and in the project which door \
is shut and where the box is. Grading may use other seeds, so do not rely on one run."""


class AssignmentError(RosminiError):
    """The assignment cannot be made."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the parser of `rosmini assignment`."""
    parser = subparsers.add_parser(
        "assignment",
        help="write a notebook with chosen exercises",
        description="Write a notebook with exercises of the chapters, without solutions, whose checks use a seed.",
        epilog="for example: rosmini assignment week2.ipynb --exercises stop,gentle --seed 5",
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="the notebook to write; it must not exist")
    parser.add_argument("--exercises", metavar="NAMES", required=True, help="names of the exercises, with commas")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the simulations (default: as in the book)")


def main(args: argparse.Namespace) -> int:
    """Write the notebook. Raises `AssignmentError` if it exists, and `UnknownExercise`."""
    if args.file.exists():
        raise AssignmentError(f"{args.file} exists already; remove it, or choose another name")
    names = [name.strip() for name in args.exercises.split(",")]
    for name in names:
        checks.find(name)
    made = assignment(find_checkout() / "notebooks", names, args.seed)
    args.file.parent.mkdir(parents=True, exist_ok=True)
    stored.write(made, args.file)
    print(f"{args.file}: {len(names)} exercises, seed {args.seed}")
    return 0


def assignment(folder: Path, names: list[str], seed: int = 0) -> nbformat.NotebookNode:
    """Return a notebook with these exercises of the chapters in a folder, in this order."""
    from nbformat import v4

    make: Any = v4

    chapters = {path: stored.read(path) for path in sorted(folder.rglob("*.ipynb"))}
    made: nbformat.NotebookNode = make.new_notebook(
        metadata={"kernelspec": stored.KERNELSPEC, "language_info": stored.LANGUAGE}
    )
    made.cells = [make.new_markdown_cell(NOTE.format(seed=seed)), make.new_code_cell(START)]
    folded: dict[str, nbformat.NotebookNode] = {}
    tasks: list[nbformat.NotebookNode] = []
    for number, name in enumerate(names, 1):
        chapter = next(each for each in chapters.values() if name in stubs(each))
        for cell in chapter.cells:
            if "hide-input" in cell.metadata.get("tags", []):
                folded[cell.source] = cell
        for cell in task(chapter, name):
            cell.source = HEADING.sub(f"### Exercise {number}", cell.source)
            if seed and cell.cell_type == "code":
                cell.source = re.sub(rf'^(check\("{name}".*)\)$', rf"\1, seed={seed})", cell.source, flags=re.MULTILINE)
            tasks.append(cell)
    made.cells += [copy.deepcopy(cell) for cell in folded.values()] + tasks
    for place, cell in enumerate(made.cells):
        cell.id = f"assignment-{place:02}"
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    return made


def task(chapter: nbformat.NotebookNode, name: str) -> list[nbformat.NotebookNode]:
    """Return the cells of an exercise: its text, its stub and its check, without hints and solutions."""
    cells = without_solutions(chapter).cells
    last = check_cells(chapter)[name]
    first = max(place for place in range(last) if HEADING.search(cells[place].source))
    *_, begin = HEADING.finditer(cells[first].source)
    cells[first].source = cells[first].source[begin.start() :]
    found: list[nbformat.NotebookNode] = cells[first : last + 1]
    return found
