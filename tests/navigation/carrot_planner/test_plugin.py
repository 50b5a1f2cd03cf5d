"""carrot_planner."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.navigation.carrot_planner.carrot import nearest_legal_pose
from rosmini.navigation.carrot_planner.plugin import CarrotPlanner
from rosmini.navigation.nav_core import BaseGlobalPlanner, GoalBlocked, PlanningFailure, planar_pose

from ..fake_costmap import planner, pose


def test_back_along_the_line_turning_the_short_way():
    found = nearest_legal_pose((0, 0, 3.0), (2, 1, -3.0), lambda pose: pose[0] < 1.001)
    turn = 2 * math.pi - 6.0
    assert found == pytest.approx((1.0, 0.5, 3.0 + turn / 2))


def test_the_plan_ends_where_the_footprint_fits():
    costs = np.zeros((30, 40), np.uint8)
    costs[:, 20:22] = 254
    made, _, _ = planner(CarrotPlanner, costs)
    assert BaseGlobalPlanner.named("carrot_planner/CarrotPlanner") is CarrotPlanner
    start = pose(0.05, -1.0)
    plan = made.make_plan(start, pose(1.04, -1.0))
    assert plan[0] is start
    # The wall begins at x = 1.0, and the footprint reaches 0.15 m ahead.
    assert planar_pose(plan[1])[0] == pytest.approx(0.84, abs=0.011)
    assert planar_pose(made.make_plan(start, pose(0.5, -1.0))[1])[0] == pytest.approx(0.5)
    # As in ROS, what is on the way does not matter.
    assert planar_pose(made.make_plan(start, pose(2.0, -1.0))[1])[0] == pytest.approx(2.0)


def test_a_robot_that_fits_nowhere_and_a_goal_in_another_frame():
    made, _, _ = planner(CarrotPlanner, np.full((30, 40), 254))
    with pytest.raises(GoalBlocked, match="could not find a valid plan for this goal: on the line from"):
        made.make_plan(pose(0, 0), pose(1, 0))
    with pytest.raises(PlanningFailure, match="only accept goals in the map frame, but a goal was sent in the odom"):
        made.make_plan(pose(0, 0), pose(1, 0, frame="odom"))
