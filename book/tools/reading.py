"""What a reader needs for a chapter: the time it takes, and for a downloaded notebook the way to run it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from . import solutions
from .captions import CAPTION

if TYPE_CHECKING:
    import nbformat

WORDS_A_MINUTE = 150
MINUTES_A_CELL = 1
MINUTES_AN_EXERCISE = 10
STATED = re.compile(r"\bAllow \d+ minutes\b")
"""The time, as the first cell of a chapter states it."""
DIRECTIONS_ID = "how-to-run-this"


def length(notebook: nbformat.NotebookNode) -> tuple[int, int]:
    """The numbers of words and code cells of a chapter before its exercises, without fenced code, tags and captions."""
    words = cells = 0
    for cell in notebook.cells:
        text, exercises, _ = cell.source.partition("\n## Exercises\n")
        if cell.cell_type == "markdown":
            prose = re.sub(r"^```.*?^```|</?\w+>", "", CAPTION.sub("", text), flags=re.DOTALL | re.MULTILINE)
            words += len(re.findall(r"\S*\w\S*", prose))
        else:
            cells += 1
        if exercises:
            break
    return words, cells


def minutes(notebook: nbformat.NotebookNode) -> int:
    """Estimate how long a chapter takes, exercises included [min], rounded up to five (DESIGN section 7)."""
    words, cells = length(notebook)
    total = words / WORDS_A_MINUTE + cells * MINUTES_A_CELL + len(solutions.stubs(notebook)) * MINUTES_AN_EXERCISE
    return -5 * int(-total // 5)


def state_minutes(notebook: nbformat.NotebookNode) -> None:
    """Write the estimated time into the first cell, in place, where it states one."""
    notebook.cells[0].source = STATED.sub(f"Allow {minutes(notebook)} minutes", notebook.cells[0].source, count=1)


def add_directions(notebook: nbformat.NotebookNode, name: str, url: str) -> None:
    """Put a cell before a notebook, in place, that says how to get the library and the other files it needs."""
    from nbformat.v4 import new_markdown_cell

    copy = f"a copy of the book's repository (`git clone {url}`)" if url else "a copy of the book's repository"
    text = (
        f"*To run this notebook you need {copy} and Python 3.11 or newer. In that folder, type "
        f"`pip install uv && uv run rosmini lab` and open `{name}`. "
        "The package called rosmini on the package index is a different project.*"
    )
    if not notebook.cells or notebook.cells[0].get("id") != DIRECTIONS_ID:
        cell = new_markdown_cell(text, id=DIRECTIONS_ID)  # type: ignore[no-untyped-call]
        notebook.cells.insert(0, cell)
