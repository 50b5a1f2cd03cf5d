"""Choosing velocities by the Dynamic Window Approach."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.core.geometry.poses import arc
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.dwa_local_planner.dwa_planner import CRITICS, DWAPlanner, DWAPlannerParameters

FOOTPRINT = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])
BURGER = DWAPlannerParameters(
    max_vel_trans=0.22, min_vel_trans=0.11, max_vel_x=0.22, min_vel_x=-0.22, max_vel_y=0.0, min_vel_y=0.0,
    max_vel_theta=2.75, min_vel_theta=1.37, acc_lim_y=0.0, sim_time=1.5, vx_samples=20, vy_samples=1, vth_samples=40,
    path_distance_bias=32.0, goal_distance_bias=20.0, occdist_scale=0.02,
)  # fmt: skip


def straight(length=2.0):
    xs = np.arange(0, length, 0.025)
    return np.column_stack([xs, np.zeros_like(xs), np.zeros_like(xs)])


def planned(grid, plan, pose=(0.0, 0.0, 0.0), velocity=(0.0, 0.0, 0.0), parameters=BURGER):
    planner = DWAPlanner(parameters, 0.1)
    planner.update_plan(grid, pose, plan, FOOTPRINT)
    return planner, planner.find_best(grid, pose, np.array(velocity))


def local_grid():
    return Costmap2D(60, 60, 0.05, (-1.5, -1.5))


def test_on_a_straight_plan_it_drives_straight_on():
    _, samples = planned(local_grid(), straight())
    assert samples.commands[samples.best].tolist() == [0.22, 0.0, 0.0]
    assert samples.counts() == {"generator": samples.refused}


def test_the_window_is_what_one_cycle_reaches():
    _, samples = planned(local_grid(), straight(), velocity=(0.1, 0, 1.5))
    assert np.ptp(samples.velocities[:, 2]) <= 0.64 + 1e-9
    assert samples.velocities[:, 2].max() == pytest.approx(1.82)


def test_trajectories_are_chords_of_the_arc():
    """Euler's steps, as in ROS: the last point lies near the arc of the same velocity."""
    _, samples = planned(local_grid(), straight(), velocity=(0.2, 0, 1.0))
    for number in range(0, len(samples), 17):
        points, (v, _, w) = samples.trajectory(number), samples.commands[number]
        after = 1.5 * (len(points) - 1) / len(points)
        x, y, theta = arc((0.0, 0.0, 0.0), v, w, after)
        assert points[-1, 2] == pytest.approx(theta)
        assert math.dist(points[-1, :2], (x, y)) < 0.5 * abs(v * w) * after * 1.5 / len(points) + 1e-9


def test_a_wall_ahead_rejects_what_runs_into_it():
    grid = local_grid()
    grid.costs[5:, 36:40] = 254
    planner, samples = planned(grid, straight(0.6), velocity=(0.2, 0, 0))
    assert samples.counts()["obstacle"] > 0
    hit = int(np.flatnonzero(samples.rejected_by == CRITICS.index("obstacle"))[0])
    assert samples.reason(hit).startswith("obstacle: the footprint meets an obstacle at point ")
    assert planner.why_not(grid, (0.0, 0.0, 0.0), np.zeros(3), np.array([0.22, 0, 0])).startswith("obstacle")
    assert planner.why_not(grid, (0.0, 0.0, 0.0), np.zeros(3), np.array([-0.22, 0, 0])) == ""


def test_totals_are_the_sum_of_what_the_critics_gave():
    grid = local_grid()
    grid.costs[:] = np.random.default_rng(3).integers(0, 200, grid.costs.shape)
    _, samples = planned(grid, straight(), velocity=(0.15, 0, 0.5))
    for number in np.flatnonzero(samples.accepted)[::31]:
        assert samples.totals[number] == pytest.approx((samples.raw[number] * samples.scales).sum())
    assert samples.best == int(np.argmin(np.where(samples.accepted, samples.totals, np.inf)))


def test_near_the_goal_the_nose_may_leave_the_plan():
    planner, samples = planned(local_grid(), straight(0.3))
    assert dict(zip(CRITICS, samples.scales, strict=True))["alignment"] == 0
    planner.update_plan(local_grid(), (0.0, 0.0, 0.0), straight(), FOOTPRINT)
    assert planner.scales(0.05)[3] == pytest.approx(1.6)


def test_a_holonomic_robot_goes_sideways_to_a_goal_beside_it():
    free = DWAPlannerParameters(
        max_vel_y=0.3, min_vel_y=-0.3, min_vel_theta=0.0, min_vel_trans=0.05, forward_point_distance=0.0
    )
    plan = np.column_stack([np.zeros(40), np.arange(40) * 0.025, np.zeros(40)])
    _, samples = planned(local_grid(), plan, velocity=(0.0, 0.2, 0.0), parameters=free)
    assert samples.commands[samples.best, 1] > 0.25


def test_steps_of_no_size_are_refused():
    from dataclasses import replace

    with pytest.raises(ParameterError, match="sim_granularity is 0"):
        DWAPlanner(replace(BURGER, sim_granularity=0.0))
    planner = DWAPlanner(replace(BURGER, sim_granularity=1e-7))
    planner.update_plan(local_grid(), (0, 0, 0), straight(), FOOTPRINT)
    with pytest.raises(ParameterError, match="use a larger sim_granularity"):
        planner.find_best(local_grid(), (0, 0, 0), np.zeros(3))


def test_a_fast_robot_has_a_larger_footprint():
    """Above scaling_speed the outline grows, up to 1 + max_scaling_factor times."""
    grid = local_grid()
    grid.costs[34, :] = 254
    fast = DWAPlannerParameters(max_vel_y=0.0, min_vel_y=0.0, max_scaling_factor=2.0, vy_samples=1)
    _, samples = planned(grid, straight(), velocity=(0.5, 0, 0), parameters=fast)
    on = int(np.argmin(np.abs(samples.velocities - (0.55, 0, 0)).sum(axis=1)))
    assert samples.reason(on).startswith("obstacle")
    slow = int(np.argmin(np.abs(samples.velocities - (0.375, 0, 0)).sum(axis=1)))
    assert samples.commands[slow, 0] < samples.commands[on, 0]
