"""Chapter 71: its size and its figures, and that the robot ends by itself, as the text says."""

from __future__ import annotations

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_short, figure_numbers, printed

CHAPTER = NOTEBOOKS / "71_frontier_exploration.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_every_figure_is_numbered_in_order(cells):
    assert figure_numbers(CHAPTER.stem) == list(range(1, 6))


def test_it_ends_by_itself_as_the_text_says(cells):
    assert "Finished exploring room" in printed(cells, "rosmini.wait(45)")
    assert printed(cells, "ask = rospy").strip() == "No valid frontiers found, exploration complete"


def test_frontiers_by_hand(cells):
    assert printed(cells, "def is_frontier").count("F") == 4
    assert "cells around" in printed(cells, "find_frontiers(before")


def test_a_polygon_whose_edges_cross_is_refused(cells):
    assert "Not a valid polygon, restarting: the edges after vertices 1 and 3" in printed(
        cells, "(2, 2), (2, 0)"
    )
