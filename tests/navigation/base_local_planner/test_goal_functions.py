"""The part of the plan that concerns the local planner."""

from __future__ import annotations

import math

import numpy as np

from rosmini.navigation.base_local_planner.goal_functions import is_stopped, passed_count, slice_in_reach, turn_to_goal
from rosmini.navigation.costmap_2d.costmap import Costmap2D

PLAN = np.column_stack([np.arange(0, 10, 0.5), np.zeros(20), np.zeros(20)])


def test_from_the_first_pose_in_reach_to_the_first_that_is_not():
    grid = Costmap2D(60, 40, 0.05)
    part = PLAN[slice_in_reach(PLAN, (4.0, 0.0, 0.0), grid)]
    assert part[[0, -1], 0].tolist() == [2.5, 6.0]
    assert slice_in_reach(PLAN, (4.0, 9.0, 0.0), grid) == slice(0, 0)


def test_what_lies_a_metre_behind_is_pruned():
    assert passed_count(PLAN, (4.0, 0.0, 0.0)) == 7
    assert passed_count(PLAN, (4.0, 5.0, 0.0)) == len(PLAN)


def test_turns_are_the_short_way_round():
    assert math.isclose(turn_to_goal((0, 0, 3.0), (0, 0, -3.0)), 2 * math.pi - 6)


def test_standing_is_standing_in_all_directions():
    assert is_stopped(np.array([0.1, -0.1, 0.1]), 0.1, 0.1)
    assert not any(is_stopped(np.array(each), 0.1, 0.1) for each in ([0.2, 0, 0], [0, -0.2, 0], [0, 0, 0.2]))
