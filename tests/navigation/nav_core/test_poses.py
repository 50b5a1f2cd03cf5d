"""Goals: what is a pose in the plane, and what is refused."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.time import Time
from rosmini.navigation.nav_core import BadGoal, planar_pose, pose_stamped
from rosmini.navigation.nav_core.poses import checked_goal

numbers = st.floats(-100, 100)


@given(numbers, numbers, st.floats(-math.pi, math.pi))
def test_a_pose_comes_back_out_of_its_message(x, y, yaw):
    message = pose_stamped("map", Time(3), (x, y, yaw))
    assert (message.header.frame_id, message.header.stamp) == ("map", Time(3))
    for found in (planar_pose(message), planar_pose(message.pose), checked_goal(message)):
        assert found[:2] == (x, y)
        assert math.cos(found[2] - yaw) == pytest.approx(1)


@pytest.mark.parametrize(
    ("quaternion", "said"),
    [
        ((0, 0, 0, 0), r"length is 0.000, not 1 \(.*set orientation.w = 1\)"),
        ((0, 0, 0, math.nan), "nans or infs"),
        ((0, 0, math.inf, 1), "nans or infs"),
        ((0, 0, 2, 0), "length is 2.000, not 1"),
        ((1, 0, 0, 0), "tilts the robot by 180.0 degrees"),
        ((0.5, 0.5, 0.5, 0.5), "tilts the robot by 90.0 degrees"),
    ],
)
def test_a_quaternion_that_is_no_heading_is_refused(quaternion, said):
    goal = pose_stamped("map", Time(0), (1.0, 2.0, 0.0))
    q = goal.pose.orientation
    q.x, q.y, q.z, q.w = quaternion
    with pytest.raises(BadGoal, match=said) as raised:
        checked_goal(goal)
    assert repr(raised.value.numbers["quaternion"]) == repr(quaternion)


def test_a_position_that_is_no_number_is_refused():
    with pytest.raises(BadGoal, match=r"the goal's position is \(nan, 2.0, 0.0\)"):
        checked_goal(pose_stamped("map", Time(0), (math.nan, 2.0, 0.0)))
