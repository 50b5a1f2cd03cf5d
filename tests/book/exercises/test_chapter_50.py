"""Chapter 50: its size, its figures, and that its terminals answer what the text says."""

from __future__ import annotations

import re

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_figures_are_numbered, assert_short, printed

CHAPTER = NOTEBOOKS / "50_environment.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert_figures_are_numbered("50_environment", (".replay(", "%rqt_graph"))


def test_a_second_terminal_has_to_source_for_itself(cells):
    first, second = re.findall(r"printenv \| grep ROS\n((?:[A-Z_]+=.*\n)*)", printed(cells, "--at second"))
    assert first == ""
    assert "ROS_PACKAGE_PATH=/opt/ros/noetic/share\n" in second


def test_the_slip_in_the_path_is_found(cells):
    said = printed(cells, "report_ws/scr")
    assert "package 'turtlebot3_ds' not found" in said
    assert "Not all paths in ROS_PACKAGE_PATH" in said
    mended = printed(cells, "source ~/report_ws/devel")
    assert mended.rstrip().endswith("~/report_ws/src/turtlebot3_ds")
