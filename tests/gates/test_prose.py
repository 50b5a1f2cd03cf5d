"""Pages, notebooks, docstrings, comments and messages avoid the words that `prose.toml` lists."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LISTS = tomllib.loads((Path(__file__).parent / "prose.toml").read_text(encoding="utf-8"))
ADVICE = {words: advice for name in ("avoid", "american") for words, advice in LISTS[name].items()}
AVOIDED = re.compile(rf"\b(?:{'|'.join(f'({words})' for words in ADVICE)})\b")
NO_PROSE = re.compile(
    r"^ *(```|~~~)(?!\{).*?^ *\1|``?[^`\n]*``?|\]\([^)\s]*\)|<[^>\n]*>|https?://\S+", re.MULTILINE | re.DOTALL
)
"""Fenced code, code between backticks, addresses, and tags."""
PROSE_OF_PYTHON = re.compile(r'"""[\s\S]*?"""|"(?:[^"\\\n]|\\.)*"|#.*')
"""Docstrings, other strings, and comments."""


def texts() -> Iterator[tuple[str, int, str]]:
    """The prose in pieces of three words or more: the file or its cell, the line where a piece begins, the piece."""
    for path in [*ROOT.glob("*.md"), *(ROOT / "book").glob("*.md"), *(ROOT / "book/about").glob("*.md")]:
        yield path.relative_to(ROOT).as_posix(), 1, path.read_text(encoding="utf-8")
    for path in (ROOT / "notebooks").glob("*/*.ipynb"):
        for number, cell in enumerate(json.loads(path.read_text(encoding="utf-8"))["cells"], 1):
            if cell["cell_type"] == "markdown":
                yield f"{path.relative_to(ROOT).as_posix()}, cell {number}", 1, "".join(cell["source"])
    for path in [*(ROOT / "rosmini").rglob("*.py"), *(ROOT / "book/tools").rglob("*.py")]:
        source = path.read_text(encoding="utf-8")
        for found in PROSE_OF_PYTHON.finditer(source):
            if found[0].count(" ") > 1:
                yield path.relative_to(ROOT).as_posix(), source.count("\n", 0, found.start()) + 1, found[0]


def hits(text: str) -> Iterator[tuple[int, str, str, str]]:
    """Each avoided word: its line, counted from 0, the word, the text of the line, and what to write instead.

    Python strings on one line may use American words: many are messages and names of ROS.
    """
    prose = NO_PROSE.sub(lambda found: "_" + "\n" * found[0].count("\n"), text)
    may_be_american = re.match(r'"(?!"")', text)
    for found in AVOIDED.finditer(prose.lower()):
        words, advice = list(ADVICE.items())[found.lastindex - 1]
        if words in LISTS["avoid"] or not may_be_american:
            line = prose.count("\n", 0, found.start())
            yield line, found[0], prose.splitlines()[line], advice


def test_prose_avoids_the_words_of_the_list():
    problems, used = [], set()
    for place, first, text in texts():
        for line, written, context, advice in hits(text):
            allowed = [right for right in LISTS["allow"] if re.search(right, context)]
            used.update(allowed)
            if not allowed:
                problems.append(f"{place}:{first + line}: {written!r}: write {advice} ({context.strip()[:70]})")
    problems += [f"prose.toml allows {right!r}, which is nowhere" for right in LISTS["allow"].keys() - used]
    assert not problems, "\n".join(problems)


def test_a_hit_has_a_line_and_says_what_to_write():
    text = "A line.\n\n```python\ncolor = 1\n```\n\nThe `color` is grey.\nIt begins anew."
    assert [(line, written, advice) for line, written, _, advice in hits(text)] == [(7, "anew", "again")]
