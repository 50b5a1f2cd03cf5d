"""Every chapter: its length, and the numbers of its figures."""

from __future__ import annotations

import re

import pytest

from book.tools import notebooks, reading

from .conftest import NOTEBOOKS

LONG = {"12", "14", "15", "17", "20", "23", "31", "40", "41"}
"""Chapters that have not been shortened yet."""

SILENT = LONG | {"13", "36", "37", "38", "63", "91", "93"}
"""Chapters whose text leaves out some of their figures."""


@pytest.mark.parametrize("name", sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb")))
def test_a_chapter_is_short_and_numbers_its_figures(name):
    """At most 2,300 words and 25 code cells before the exercises; each picture has a number, and the text names it."""
    notebook = notebooks.read(NOTEBOOKS / f"{name}.ipynb")
    number = name[:2]
    words, count = reading.length(notebook)
    assert (words <= 2300 and count <= 25) == (number not in LONG)

    figures = []
    for cell in (cell for cell in notebook.cells if cell.cell_type == "code"):
        titles = re.findall(rf"Figure {int(number)}\.(\d+): ", cell.source)
        pictures = [
            output
            for output in cell.outputs
            if {"image/svg+xml", "image/png"} & output.get("data", {}).keys()
        ]
        assert len(pictures) <= len(titles), cell.source
        figures += map(int, titles)
    assert figures == list(range(1, len(figures) + 1))
    prose = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    unnamed = [figure for figure in figures if f"Figure {int(number)}.{figure}" not in prose]
    assert not unnamed or number in SILENT


@pytest.mark.parametrize(("number", "moving"), [("20", 2), ("23", 2), ("40", 5), ("41", 2), ("73", 1)])
def test_a_page_holds_few_moving_pictures(number, moving):
    """Each loads a player and its data."""
    [path] = NOTEBOOKS.glob(f"{number}_*.ipynb")
    code = "".join(cell.source for cell in notebooks.read(path).cells if cell.cell_type == "code")
    assert sum(code.count(word) for word in (".show3d(", ".replay(", ".replay3d(", ".pad(title=")) <= moving
    assert path.stat().st_size < 1_500_000
