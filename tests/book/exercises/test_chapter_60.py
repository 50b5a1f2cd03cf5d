"""Chapter 60: its size, its figures, and what its cells say."""

from __future__ import annotations

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_figures_are_numbered, assert_short, printed

CHAPTER = NOTEBOOKS / "60_turtlesim_nodes.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert_figures_are_numbered("60_turtlesim_nodes", (".pad(", ".show(", "%rqt_graph"))


def test_the_slip_is_refused_and_one_command_drives_two_turtles(cells):
    assert "--name:=my_turtle" in printed(cells, "%%terminal --new")
    first, second = printed(cells, "__name:=one").strip().splitlines()[-2:]
    assert first == second


def test_a_namespace_keeps_the_windows_apart(cells):
    assert "/left/draw_square\n/left/turtlesim\n/right/turtlesim\n" in printed(cells, "__ns:=/right")
    assert "/draw_circle" in printed(cells, "rosnode ping -c 1 /draw_circle")
    assert "/draw_circle" not in printed(cells, "%rosnode cleanup").rpartition("\n/left")[2]
