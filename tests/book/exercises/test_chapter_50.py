"""Chapter 50: its size, its figures, and that its terminals answer what the text says."""

from __future__ import annotations

import re

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_figures_are_numbered

CHAPTER = NOTEBOOKS / "50_environment.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def printed(cells, start):
    """What the cell with this text in it has printed."""
    [cell] = [cell for cell in cells if cell.cell_type == "code" and start in cell.source]
    return "".join(output.get("text", "") for output in cell.outputs)


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    before = []
    for cell in cells:
        text, exercises, _ = cell.source.partition("\n## Exercises\n")
        before.append((cell.cell_type, text))
        if exercises:
            break
    assert (
        len(re.findall(r"\S*\w\S*", "\n".join(text for kind, text in before if kind == "markdown"))) <= 2000
    )
    assert sum(kind == "code" for kind, _ in before) <= 25


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
