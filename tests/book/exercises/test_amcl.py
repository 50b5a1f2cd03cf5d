"""The chapter amcl: robots are found as the text says."""

from __future__ import annotations

import re

import pytest

from .conftest import printed


def test_few_particles_settle_at_a_wrong_place(cells):
    off = re.findall(r"([\d.]+) m off", printed(cells, "def last(number"))
    assert float(off[0]) > 1.0


def test_amcl_corrects_where_the_odometry_began(cells):
    x, y = re.findall(r"Translation: \[(\S+), (\S+),", printed(cells, "2D Pose Estimate"))[0]
    assert (float(x), float(y)) == pytest.approx((6.3, -0.5), abs=0.6)


def test_the_robot_that_found_itself_delivers(cells):
    replay = next(cell for cell in cells if "%replay /move_base/NavfnROS/plan /particlecloud" in cell.source)
    text = next(output.data["text/plain"] for output in replay.outputs if "data" in output)
    x, y = re.findall(r"end \((\S+), (\S+),", text)[0]
    assert (float(x), float(y)) == pytest.approx((1.2, -0.9), abs=0.3)
