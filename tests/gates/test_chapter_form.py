"""What the design says of a chapter's form, counted."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from book.tools import notebooks, reading
from book.tools.captions import CAPTION

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"
CHAPTERS = {path.stem[3:]: path for path in sorted(NOTEBOOKS.rglob("*.ipynb"))}

MAX_WORDS, MAX_CELLS, MAX_COLUMNS, MAX_LINES, MAX_SCRIPT_LINES = 2300, 25, 79, 15, 50
PRIVATE = re.compile(r"\bGraph\(|\bdefault_graph\(|\.program\b|\.instance\(\)|\bScene\(|\bTools\(|\.node\(")
"""The object API."""
LOOKS_INSIDE = {"the_wire", "how_it_works"}
"""Chapters that look inside rosmini, and say so: they use its object API."""
MOTION = re.compile(
    r"\brosmini\.wait\(|\bgraph\.run\(|%replay|%rostopic (?:echo|hz)|%%terminal|%roslaunch|%%logo|%catkin"
)
"""Cells in which time passes or a command answers."""


def code_cells(chapter: str) -> list[Any]:
    """Return the code cells before the exercises."""
    cells = notebooks.read(CHAPTERS[chapter]).cells
    ends = [i for i, cell in enumerate(cells) if "\n## Exercises\n" in f"\n{cell.source}\n"]
    return [cell for cell in cells[: ends[0] if ends else None] if cell.cell_type == "code"]


def lacks_hint(notebook: Any) -> bool:
    """Return whether an exercise has no hint."""
    _, _, exercises = "\n".join(notebooks.prose(notebook)).partition("\n## Exercises\n")
    return any("<summary>Hint" not in text for text in exercises.split("\n### Exercise ")[1:])


def is_picture(cell: Any) -> bool:
    """Return whether a cell has drawn something."""
    kinds = {kind for output in cell.get("outputs", ()) for kind in output.get("data", {})}
    return bool(kinds & {"image/svg+xml", "image/png"})


def broken_rules(chapter: str) -> set[str]:
    """Return the rules of DESIGN, section 7, that a chapter breaks."""
    notebook = notebooks.read(CHAPTERS[chapter])
    prose = "\n".join(notebooks.prose(notebook))
    words, cells = reading.length(notebook)
    code = code_cells(chapter)
    shown = [cell.source for cell in code if "hide-input" not in cell.metadata.get("tags", ())]
    scripts = [source for source in shown if source.startswith("%%")]
    plain = [source for source in shown if not source.startswith("%%")]
    first = next((i for i, source in enumerate(shown) if MOTION.search(source)), len(shown))
    found = {
        "words": words > MAX_WORDS,
        "cells": cells > MAX_CELLS,
        "columns": any(len(line) > MAX_COLUMNS for source in shown for line in source.splitlines()),
        "lines": any(source.count("\n") >= MAX_LINES for source in plain)
        or any(source.count("\n") > MAX_SCRIPT_LINES for source in scripts),
        "private API": chapter not in LOOKS_INSIDE and any(PRIVATE.search(cell.source) for cell in code),
        "first motion": first >= 5,
        "captions": any(
            is_picture(cell) and not CAPTION.match(below.source) for cell, below in pairwise(notebook.cells)
        ),
        "hints": lacks_hint(notebook),
        "time": f"Allow {reading.minutes(notebook)} minutes" not in notebook.cells[0].source,
        "mentions": any(f"](#{found['label']})" not in prose for found in CAPTION.finditer(prose)),
    }
    return {rule for rule, is_broken in found.items() if is_broken}


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_a_chapter_has_the_form_of_the_design(chapter: str) -> None:
    assert not broken_rules(chapter)
