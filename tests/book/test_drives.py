"""Drives: launch files with the whole Navigation Stack, in a graph of their own."""

from __future__ import annotations

import pytest

from rosmini.book.checks import Wrong
from rosmini.book.drives import Drive, courier

HERE = (-3.0, 1.0, 0.0)


def test_two_goals_one_after_the_other_are_both_reached():
    drive, settings = courier("DWAPlannerROS: {xy_goal_tolerance: 0.1}", "settings", HERE)
    with drive:
        assert settings == {"DWAPlannerROS": {"xy_goal_tolerance": 0.1}}
        for goal in ((-2.0, 1.0, 0.0), (-1.2, 1.0, 0.0)):
            drive.expect_arrival(goal, 20.0, "")


def test_a_launch_file_without_a_robot_is_a_wrong_answer():
    with pytest.raises(Wrong, match="/simulator"):
        Drive("<launch/>")
