"""Chapter 74: its figures are numbered, and what it says of the three graphs holds."""

from __future__ import annotations

from pathlib import Path

import pytest

from book.tools import notebooks

from .conftest import assert_figures_are_numbered

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "74_beyond.ipynb"

FIGURES = ("rqt_graph(before", "rqt_graph(\n", ".replay(")


@pytest.fixture(scope="module")
def figures():
    return [
        "".join(output.data.get("text/plain", ""))
        for cell in notebooks.read(CHAPTER).cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type != "stream"
    ]


def test_every_figure_is_numbered_in_order():
    assert_figures_are_numbered(CHAPTER.stem, FIGURES)


def test_the_robot_arrived_on_a_map_that_grew(figures):
    assert "/map: 1 message" not in figures[0]
    assert "/map: " in figures[0]
    assert "/move_base/NavfnROS/plan: " in figures[0]


def test_teleoperation_adds_a_node_and_an_arrow_and_a_second_start_adds_nothing(figures):
    assert "4 nodes" in figures[1]
    assert (
        "new: /turtlebot3_teleop_keyboard, /turtlebot3_teleop_keyboard -> /cmd_vel -> /simulator"
        in figures[2]
    )
    assert "new: " not in figures[3]


def test_the_master_says_why_the_older_mapper_ended():
    said = "".join(
        output.text
        for cell in notebooks.read(CHAPTER).cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if output.output_type == "stream"
    )
    assert "new node registered with same name" in said
