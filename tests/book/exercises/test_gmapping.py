"""The chapter GMapping: its outputs are what the text says of them."""

from __future__ import annotations

import re

import pytest

from .conftest import printed


def test_the_saved_map_has_whole_blocks(cells):
    assert "384 X 384" in printed(cells, "map_saver -f house")


def test_a_climb_from_odometry_ends_higher_than_one_from_a_wrong_heading(cells):
    good, bad = (int(score) for score in re.findall(r"score (\d+)", printed(cells, "starts = {")))
    assert good > bad


def test_matching_is_better_than_odometry_alone(cells):
    alone, matched = (float(off) for off in re.findall(r"([\d.]+) m off", printed(cells, "def off(path)")))
    assert alone > 2 * matched


def test_the_robot_delivers_on_its_own_map(cells):
    replay = next(cell for cell in cells if "localization:=amcl" in cell.source)
    text = next(output.data["text/plain"] for output in replay.outputs if "data" in output)
    x, y = re.findall(r"end \((\S+), (\S+),", text)[0]
    assert (float(x), float(y)) == pytest.approx((1.7, -1.5), abs=0.3)
