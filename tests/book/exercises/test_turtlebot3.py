"""The chapter TurtleBot3: its script prints what the page shows, and its boxes name what exists."""

from __future__ import annotations

import re

import pytest

from .conftest import assert_scripts_print_what_is_shown, printed


def test_the_listed_script_prints_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"square.py"})


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


def test_fifty_robots_drift_as_the_formulas_say(cells):
    straight = re.findall(r"sideways +([\d.]+) cm, predicted +([\d.]+);", printed(cells, "for way in range(1, 6):"))
    assert len(straight) == 5
    rows = re.findall(r"([\d.]+) (?:cm|deg) \( ?([\d.]+)\)", printed(cells, "alone = replace("))
    assert len(rows) == 16
    for measured, predicted in [*straight, *rows]:
        # a standard deviation from fifty robots is good to a tenth
        assert float(measured) == pytest.approx(float(predicted), rel=0.25, abs=0.1)


def test_the_numbers_of_the_text_are_printed(cells, prose):
    fit = printed(cells, "def ellipse(")
    within = re.findall(r": (\d+) of 50 robots", fit)
    assert f"on the straight way it is only {within[0]}" in prose.lower() and f"{within[1]} of 50, where" in prose
    off = re.findall(r"([\d.]+) mm and +(-?[\d.]+) deg", printed(cells, "def compare("))
    assert all(float(number) == 0 for pair in off[:4] for number in pair)
    largest = max(float(pair[0]) for pair in off[4:]), max(abs(float(pair[1])) for pair in off[4:])
    assert f"off by up to {largest[0]} mm and {largest[1]} degrees" in prose
