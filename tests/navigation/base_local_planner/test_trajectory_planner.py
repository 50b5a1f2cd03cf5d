"""Choosing velocities by Trajectory Rollout."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rosmini.navigation.base_local_planner.trajectory_planner import (
    TrajectoryPlanner,
    TrajectoryPlannerParameters,
    Turning,
)
from rosmini.navigation.costmap_2d.costmap import Costmap2D

FOOTPRINT = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])
WHEELS = TrajectoryPlannerParameters(holonomic_robot=False)


def local_grid():
    return Costmap2D(60, 60, 0.05, (-1.5, -1.5))


def planned(plan, parameters=WHEELS, grid=None, velocity=(0.0, 0.0, 0.0), pose=(0.0, 0.0, 0.0)):
    grid = grid or local_grid()
    planner = TrajectoryPlanner(parameters, 0.1)
    planner.update_plan(grid, pose, np.array(plan, dtype=float), FOOTPRINT)
    return planner, planner.find_best(grid, pose, np.array(velocity))


AHEAD = [(x, 0.0, 0.0) for x in np.arange(0, 1.4, 0.05)]


def test_straight_on_if_the_plan_is_straight():
    _, samples = planned(AHEAD)
    assert samples.commands[samples.best, 2] == 0
    assert samples.commands[samples.best, 0] == pytest.approx(min(0.55, 1.35 / 1.7))


def test_it_does_not_overshoot_the_goal():
    planner, _ = planned([(0, 0, 0), (0.34, 0, 0)])
    assert planner.window((0.0, 0.0, 0.0), np.zeros(3))[1][0] == pytest.approx(0.2)


def test_with_dwa_the_window_is_one_cycle():
    planner, samples = planned(AHEAD, replace(WHEELS, dwa=True), velocity=(0.2, 0.0, 0.0))
    assert planner.window((0.0, 0.0, 0.0), np.array([0.2, 0, 0])) == (
        (0.0, pytest.approx(-0.32)),
        (pytest.approx(0.45), pytest.approx(0.32)),
    )
    assert len(samples) == 20 * 20 + 20


def test_who_turned_right_twice_may_not_turn_left():
    turning = Turning()
    turning.record(-1.0)
    assert not turning.stuck_right
    turning.record(-1.0)
    assert turning.stuck_right
    assert not turning.stuck_left


def test_a_velocity_comes_up_to_the_sample_by_the_acceleration():
    slow = replace(WHEELS, acc_lim_x=0.1)
    _, samples = planned(AHEAD, slow)
    number = int(np.argmin(np.abs(samples.velocities - (0.17, 0.0, 0.0)).sum(axis=1)))
    points = samples.trajectory(number)
    dt = 1.7 / len(points)
    speeds = np.diff(points[:, 0]) / dt
    assert np.allclose(np.diff(speeds), 0.1 * dt)


def test_a_holonomic_robot_steps_aside_when_nothing_else_is_possible():
    grid = local_grid()
    grid.costs[24:37, 31:33] = 254
    grid.costs[24:37, 26:27] = 254
    boxed = np.array([(-0.11, -0.05), (-0.11, 0.05), (0.04, 0.05), (0.04, -0.05)])
    planner = TrajectoryPlanner(TrajectoryPlannerParameters(y_vels="-0.3,0.3", min_vel_x=0.1), 0.1)
    planner.update_plan(grid, (0.0, 0.0, 0.0), np.array([(0, 0, 0), (0, 1.0, 0)]), boxed)
    samples = planner.find_best(grid, (0.0, 0.0, 0.0), np.zeros(3))
    assert samples.commands[samples.best].tolist() == [0.0, 0.3, 0.0]


def test_it_backs_up_until_it_is_free_again():
    grid = local_grid()
    grid.costs[26:35, 32:36] = 254
    grid.costs[33:36, 20:32] = 254
    grid.costs[25:28, 20:32] = 254
    planner, samples = planned(AHEAD, grid=grid)
    assert samples.commands[samples.best].tolist() == [-0.1, 0.0, 0.0]
    assert planner.escaping
    free = local_grid()
    planner.update_plan(free, (-0.05, 0.0, 0.0), np.array(AHEAD), FOOTPRINT)
    samples = planner.find_best(free, (-0.05, 0.0, 0.0), np.zeros(3))
    assert not (samples.velocities[:, 0] > 0).any(), "while it escapes, it does not drive on"
    planner.find_best(free, (-0.15, 0.0, 0.0), np.zeros(3))
    assert not planner.escaping


def test_meters_make_weights_independent_of_the_resolution():
    grid = local_grid()
    planner = TrajectoryPlanner(WHEELS, 0.1, meter_scoring=True)
    planner.update_plan(grid, (0.0, 0.0, 0.0), np.array(AHEAD), FOOTPRINT)
    samples = planner.find_best(grid, (0.0, 0.0, 0.0), np.zeros(3))
    assert samples.scales.tolist() == pytest.approx([0.01, 0.03, 0.04])
