"""Trajectories in a picture and in a page: what it says, and what is refused."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.dwa_local_planner.dwa_planner import DWAPlanner, DWAPlannerParameters
from rosmini.viz.trajectory_window import trajectory_window
from rosmini.viz.view import ViewError

FOOTPRINT = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])
PLAN = np.column_stack([np.arange(0, 1, 0.05), np.zeros(20), np.zeros(20)])


@pytest.fixture
def grid():
    grid = Costmap2D(60, 60, 0.05, (-1.5, -1.5))
    grid.costs[20:, 36:40] = 254
    return grid


@pytest.fixture
def samples(grid):
    parameters = DWAPlannerParameters(max_vel_y=0.0, min_vel_y=0.0, vy_samples=1, vx_samples=4, vth_samples=5)
    planner = DWAPlanner(parameters, 0.1)
    planner.update_plan(grid, (0.0, 0.0, 0.0), PLAN, FOOTPRINT)
    return planner.find_best(grid, (0.0, 0.0, 0.0), np.array([0.2, 0.0, 0.3]))


def test_it_says_what_was_chosen_and_how_many_were_rejected(samples, grid):
    view = samples.show(costmap=grid, plan=PLAN, footprint=FOOTPRINT, title="Figure 1: Tried")
    head, best, rejected = view.text.split("\n")
    assert head == f"Figure 1: Tried: {len(samples)} of {len(samples) + samples.refused} velocities driven"
    assert best.startswith("best: 0.")
    assert " cost " in best
    assert rejected == f"rejected: obstacle {samples.counts()['obstacle']}"
    assert view.svg.count('class="tx"') == samples.counts()["obstacle"] + 1
    assert view.svg.count("<polygon") == 2
    assert view.svg.count("<image") == 1


def test_the_page_gets_all_of_them_the_cheapest_first(samples, grid):
    data = samples.show(costmap=grid, footprint=FOOTPRINT).data
    points = np.frombuffer(data["points"], dtype="<i2").reshape(-1, 3) / 1000 + (*data["area"][:2], 0.0)
    first = samples.trajectory(samples.best)
    assert np.allclose(points[: len(first)], first, atol=0.002)
    assert len(points) == samples.lengths.sum()
    assert data["chosen"] == 0
    costs = np.array(data["gave"]) @ data["weights"]
    accepted = np.array(data["shades"]) >= 0
    assert np.all(np.diff(costs[accepted]) > -0.01)
    assert not accepted[accepted.sum() :].any()
    assert data["reasons"][-1].startswith("obstacle: ")


def test_a_rejected_one_can_be_chosen(samples):
    number = int(np.flatnonzero(~samples.accepted)[0])
    view = samples.show(chosen=number)
    assert f"number {number}: " in view.text
    assert "rejected by obstacle: the footprint meets an obstacle" in view.text


def test_noise_in_the_last_digits_changes_no_byte(samples, grid):
    from dataclasses import replace

    noisy = replace(samples, points=samples.points * (1 + 1e-14), totals=samples.totals * (1 + 1e-14))
    options = {"costmap": grid, "plan": PLAN, "footprint": FOOTPRINT}
    assert noisy.show(**options).html == samples.show(**options).html


def test_a_picture_alone_has_its_colours_too(samples, grid):
    """Where no page sets the palette, as in a viewer of notebooks, a colour without a fallback is none."""
    svg = trajectory_window(samples, costmap=grid).svg
    assert re.findall(r"var\(--rosmini-[a-z]+\)", svg) == []


def test_what_cannot_be_shown_is_told(samples):
    with pytest.raises(ViewError, match="no trajectories to show"):
        trajectory_window(None)
    with pytest.raises(ViewError, match="there is no trajectory 9999"):
        samples.show(chosen=9999)
    with pytest.raises(ViewError, match="300 x 300 cells"):
        samples.show(costmap=Costmap2D(300, 300, 0.05))
