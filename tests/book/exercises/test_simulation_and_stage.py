"""The chapter Simulation and Stage: its numbers are Stage's, and its solutions drive where they are said to."""

from __future__ import annotations

import math
import re

import pytest

from book.tools import solutions
from rosmini import Graph, rosrun
from rosmini.msgs import message_class
from rosmini.sim.stage import load


def test_parameters_that_the_text_names_exist(chapter):
    from rosmini.sim.simulator import SimulatorParameters
    from rosmini.sim.stage.node import StageParameters

    everything = "\n".join(cell.source for cell in chapter.cells)
    named = set(re.findall(r"[\s`\"](_\w+):=", everything))
    known = {row[0].replace("~", "_") for each in (SimulatorParameters, StageParameters) for row in each.table()}
    assert {"_world", "_noise", "_base_watchdog_timeout"} <= named <= known


def test_the_watchdog_and_the_bounds_are_those_of_the_text(prose, tmp_path):
    from rosmini.sim.stage.node import WATCHDOG

    assert WATCHDOG == 0.2
    assert "stops a robot that has heard nothing for 0.2 s" in prose
    assert "1 m/s and 90 degrees a second: these are Stage's bounds" in prose
    (tmp_path / "plain.world").write_text("position( )", encoding="utf-8")
    (robot,) = load(tmp_path / "plain.world").robots
    ahead, _, turning = robot.velocity_bounds
    assert ahead == (-1.0, 1.0)
    assert turning == pytest.approx((-math.pi / 2, math.pi / 2))
    assert robot.localization == "gps"


def test_only_gps_notices_that_a_robot_is_dragged(tmp_path):
    for kind, believed in (("gps", (1.0, -2.0)), ("odom", (0.0, 0.0))):
        (tmp_path / "one.world").write_text(f'position( pose [-3 0 0 0] localization "{kind}" )', encoding="utf-8")
        with Graph() as graph:
            stage = rosrun("stage_ros", "stageros", tmp_path / "one.world", graph=graph).instance()
            stage.drag("robot_0", (1.0, -2.0, 0.0))
            reckoning = stage.robot().base.reckoning
            assert stage.truth()[:2] == pytest.approx((1.0, -2.0))
            assert reckoning.pose(stage.truth())[:2] == pytest.approx(believed)


@pytest.mark.parametrize("w", [0.5, 0.0])
def test_the_solution_believes_what_stage_comes_to(chapter, tmp_path, w):
    found = {"math": math}
    exec(solutions.solutions(chapter)["belief"], found)
    text = 'position( pose [1 2 0 90] localization "odom" odom_error [0.2 0 0 0.2] )'
    (tmp_path / "mole.world").write_text(text, encoding="utf-8")
    with Graph(seed=3) as graph:
        base = rosrun("stage_ros", "stageros", tmp_path / "mole.world", graph=graph).instance().robot().base
        e_x, _, e_a = base.reckoning.errors
        base.go((0.3, 0.0, w))
        base.reckoning.advance(2.0)
    assert e_x
    assert e_a
    assert base.reckoning.belief == pytest.approx(found["belief"](0.3, w, 2.0, e_x, e_a))


def test_the_solution_slides_to_the_north_whatever_it_looks_at(chapter, tmp_path):
    found = {"math": math, "Twist": message_class("geometry_msgs/Twist")}
    exec(solutions.solutions(chapter)["world_velocity"], found)
    (tmp_path / "omni.world").write_text('position( pose [0 0 0 30] drive "omni" )', encoding="utf-8")
    with Graph() as graph:
        stage = rosrun("stage_ros", "stageros", tmp_path / "omni.world", graph=graph).instance()
        command = found["world_velocity"](0.0, 0.4, math.radians(30))
        stage.robot().base.command(command.linear.x, command.angular.z, command.linear.y)
        graph.run(0.1)
        x, y, heading = stage.truth()
    assert (x, y, heading) == pytest.approx((0.0, 0.04, math.radians(30)), abs=1e-9)
