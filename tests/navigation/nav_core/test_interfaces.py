"""Planners of one's own."""

from __future__ import annotations

import pytest

from rosmini.core.plugins import PluginError
from rosmini.navigation.nav_core import BaseGlobalPlanner, NavigationFailure, NoValidCommand


def test_a_planner_is_found_by_its_name_and_knows_its_costmap():
    class Straight(BaseGlobalPlanner, plugin="my_pkg/StraightPlanner"):
        def make_plan(self, start, goal):
            return [start, goal]

    planner = BaseGlobalPlanner.create("my_pkg::StraightPlanner")
    planner.initialize("StraightPlanner", "the costmap")
    assert (planner.name, planner.costmap) == ("StraightPlanner", "the costmap")
    assert planner.make_plan(1, 2) == [1, 2]
    with pytest.raises(PluginError, match="did you mean my_pkg/StraightPlanner"):
        BaseGlobalPlanner.create("my_pkg/StraitPlanner")


def test_a_planner_that_cannot_plan_is_not_made():
    class Idle(BaseGlobalPlanner, plugin="my_pkg/Idle"):
        pass

    with pytest.raises(TypeError, match="make_plan"):
        BaseGlobalPlanner.create("my_pkg/Idle")


def test_a_failure_keeps_the_numbers_that_explain_it():
    failure = NoValidCommand("none of 800", rejected={"obstacle": 800})
    assert isinstance(failure, NavigationFailure)
    assert (str(failure), failure.numbers) == ("none of 800", {"rejected": {"obstacle": 800}})
