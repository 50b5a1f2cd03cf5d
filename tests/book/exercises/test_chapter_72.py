"""Chapter 72: its size and its figures, and that the robot ends by itself, as the text says."""

from __future__ import annotations

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_short, figure_numbers, printed

CHAPTER = NOTEBOOKS / "72_explore_lite.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_every_figure_is_numbered_in_order(cells):
    assert figure_numbers(CHAPTER.stem) == [1, 2]


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Exploration stopped." in printed(cells, "rosmini.wait(34)")


def test_costs_as_the_text_says(cells):
    assert printed(cells, "def cost").strip().splitlines()[-1].endswith("-2.10")
    best = [line.rpartition(": ")[2] for line in printed(cells, "best = min").strip().splitlines()]
    assert best[0] == "a hall"
    assert best[-1] != "a hall"
