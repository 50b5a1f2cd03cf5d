"""The chapter Simulation and Stage: its defaults are those of the simulators."""

from __future__ import annotations

import math
import re

import pytest

from rosmini.sim.stage.world_file import load


def test_parameters_that_the_text_names_exist(chapter):
    from rosmini.sim.simulator import SimulatorParameters
    from rosmini.sim.stage.node import StageParameters

    everything = "\n".join(cell.source for cell in chapter.cells)
    named = set(re.findall(r"[\s`\"](_[a-z]\w*):=", everything))
    known = {row[0].replace("~", "_") for each in (SimulatorParameters, StageParameters) for row in each.table()}
    assert {"_world", "_noise", "_base_watchdog_timeout"} <= named <= known


def test_the_watchdog_and_the_bounds_are_those_of_the_text(prose, tmp_path):
    from rosmini.sim.stage.node import WATCHDOG

    assert WATCHDOG == 0.2
    assert "all robots stop | 0.2 s |" in prose
    assert "speed limits | 1 m/s and 90 degrees/s |" in prose
    (tmp_path / "plain.world").write_text("position( )", encoding="utf-8")
    (robot,) = load(tmp_path / "plain.world").robots
    ahead, _, turning = robot.velocity_bounds
    assert ahead == (-1.0, 1.0)
    assert turning == pytest.approx((-math.pi / 2, math.pi / 2))
    assert robot.localization == "gps"
