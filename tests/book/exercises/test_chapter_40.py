"""Chapter 40: its script prints what the page shows, its figures are numbered, and its boxes name what exists."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from book.tools import notebooks

from .conftest import assert_figures_are_numbered, assert_scripts_print_what_is_shown

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "40_turtlebot3.ipynb"

FIGURES = (
    "rqt_graph(", "scan_picture(", ".show(", ".show3d(", ".plots(", ".replay(", ".replay3d(", "matplotlib_picture(",
    "image_picture(",
)  # fmt: skip


@pytest.fixture(scope="module")
def chapter():
    return notebooks.read(CHAPTER)


@pytest.fixture(scope="module")
def prose(chapter):
    return "\n\n".join(cell.source for cell in chapter.cells if cell.cell_type == "markdown")


def test_the_listed_script_prints_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"square.py"})


def test_every_figure_is_numbered_in_order():
    assert_figures_are_numbered(CHAPTER.stem, FIGURES)


def test_a_page_holds_few_moving_pictures(chapter):
    code = "".join(cell.source for cell in chapter.cells if cell.cell_type == "code")
    assert sum(code.count(word) for word in (".show3d(", ".replay(", ".replay3d(")) == 5


def test_parameters_that_the_text_names_exist(chapter):
    from rosmini.sim.simulator import SimulatorParameters

    everything = "\n".join(cell.source for cell in chapter.cells)
    named = set(re.findall(r"[\s`\"](_\w+):=", everything))
    assert {"_world", "_noise", "_x", "_model", "_board", "_battery"} <= named
    assert named <= {row[0].replace("~", "_") for row in SimulatorParameters.table()}


def test_scripts_take_the_same_half_second_as_the_text(prose):
    from rosmini.sim.simulator import COMMAND_TIMEOUT

    assert "A command holds for **half a second**" in prose
    assert COMMAND_TIMEOUT == 0.5


def printed(chapter, word):
    """What the one code cell prints in which this word stands."""
    [cell] = [cell for cell in chapter.cells if cell.cell_type == "code" and word in cell.source]
    return "".join(output.text for output in cell.outputs if output.output_type == "stream")


def test_fifty_robots_drift_as_the_formulas_say(chapter):
    straight = re.findall(
        r"sideways +([\d.]+) cm, predicted +([\d.]+);", printed(chapter, "for way in range(1, 6):")
    )
    assert len(straight) == 5
    rows = re.findall(r"([\d.]+) (?:cm|deg) \( ?([\d.]+)\)", printed(chapter, "alone = replace("))
    assert len(rows) == 16
    for measured, predicted in [*straight, *rows]:
        # a standard deviation from fifty robots is good to a tenth
        assert float(measured) == pytest.approx(float(predicted), rel=0.25, abs=0.1)


def test_the_numbers_of_the_text_are_printed(chapter, prose):
    fit = printed(chapter, "def ellipse(")
    within = re.findall(r": (\d+) of 50 robots", fit)
    assert (
        f"on the straight way it is only {within[0]}" in prose.lower()
        and f"{within[1]} of 50, where" in prose
    )
    off = re.findall(r"([\d.]+) mm and +(-?[\d.]+) deg", printed(chapter, "def compare("))
    assert all(float(number) == 0 for pair in off[:4] for number in pair)
    largest = max(float(pair[0]) for pair in off[4:]), max(abs(float(pair[1])) for pair in off[4:])
    assert f"off by up to {largest[0]} mm and {largest[1]} degrees" in prose
