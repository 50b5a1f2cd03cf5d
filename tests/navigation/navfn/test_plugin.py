"""`navfn/NavfnROS` on a graph."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.errors import ParameterError
from rosmini.msgs import service_class
from rosmini.navigation.nav_core import GoalBlocked, OutsideMap, PlanningFailure
from rosmini.navigation.navfn.plugin import NavfnROS

from ..fake_costmap import planner, points, pose


def room() -> np.ndarray:
    """Forty by thirty cells of 0.1 m from (-1, -2) on, with a wall whose gap is at the top."""
    costs = np.zeros((30, 40), np.uint8)
    costs[:22, 18:20] = 254
    return costs


def test_a_plan_begins_at_the_robot_ends_at_the_goal_and_is_published():
    made, graph, heard = planner(NavfnROS, room())
    plan = made.make_plan(pose(0.03, -1.02), pose(2.5, -1.5, 1.0))
    graph.run(0.1)
    found = points(plan)
    assert found[0] == pytest.approx([0.05, -1.05])
    assert found[-1] == pytest.approx([2.5, -1.5])
    assert plan[-1].pose.orientation.z == pytest.approx(np.sin(0.5))
    assert {each.header.frame_id for each in plan} == {"map"}
    assert found[:, 1].max() > 0.2
    steps = np.hypot(*np.diff(found[:-1], axis=0).T)
    assert 0.02 < np.median(steps) <= 0.0501
    assert points(heard["plan"][-1].poses) == pytest.approx(found)
    for x, y in found:
        assert made.grid.cost(*made.grid.world_to_map(x, y)) < 253


def test_a_goal_in_a_wall_needs_a_tolerance():
    made, graph, heard = planner(NavfnROS, room())
    goal = pose(0.82, -1.0)
    with pytest.raises(GoalBlocked, match=r"\(0\.85, -0\.95\) is blocked: its cell has the cost 254") as caught:
        made.make_plan(pose(0.0, -1.0), goal)
    assert caught.value.numbers["distance"] == pytest.approx(0.1)
    graph.run(0.1)
    assert heard["plan"][-1].poses == []
    found = points(made.make_plan(pose(0.0, -1.0), goal, 0.3))
    assert np.abs(found[-1] - [0.82, -1.0]).max() <= 0.3
    assert found[-1][0] == pytest.approx(0.72)


def test_the_default_tolerance_is_a_parameter():
    made, _, _ = planner(NavfnROS, room(), default_tolerance=0.3)
    assert points(made.make_plan(pose(0.0, -1.0), pose(0.82, -1.0)))[-1][0] < 0.8


def test_unknown_cells_may_be_forbidden():
    costs = room()
    costs[22:, 18:20] = 255
    assert planner(NavfnROS, costs)[0].make_plan(pose(0.0, 0.0), pose(2.5, 0.0))
    with pytest.raises(PlanningFailure, match="no path leads from"):
        planner(NavfnROS, costs, allow_unknown=False)[0].make_plan(pose(0.0, 0.0), pose(2.5, 0.0))


def test_poses_off_the_map_and_in_another_frame_are_refused_with_the_real_words():
    made, _, _ = planner(NavfnROS, room())
    with pytest.raises(OutsideMap, match=r"Planning will always fail to this goal\. It is at \(9\.00"):
        made.make_plan(pose(0.0, 0.0), pose(9.0, 0.0))
    with pytest.raises(OutsideMap, match="are you sure the robot has been properly localized"):
        made.make_plan(pose(float("nan"), 0.0), pose(1.0, 0.0))
    with pytest.raises(PlanningFailure, match=r"must be in the map frame\.  It is instead in the odom frame"):
        made.make_plan(pose(0.0, 0.0), pose(1.0, 0.0, frame="odom"))


def test_the_service_plans_and_answers_an_empty_plan_if_there_is_none():
    _, graph, _ = planner(NavfnROS, room())
    get_plan = service_class("nav_msgs/GetPlan")
    client = graph.node("asker").service_client("/move_base/NavfnROS/make_plan", get_plan)
    answer = client(start=pose(0.0, -1.0), goal=pose(2.5, -1.0))
    assert len(answer.plan.poses) > 50 and answer.plan.header.frame_id == "map"
    assert list(client(start=pose(0.0, -1.0), goal=pose(9.0, 0.0)).plan.poses) == []


def test_the_potential_is_published_as_a_cloud():
    made, graph, heard = planner(NavfnROS, room(), visualize_potential=True)
    made.make_plan(pose(0.0, -1.0), pose(2.5, -1.0))
    graph.run(0.1)
    cloud = heard["potential"][-1]
    assert [field.name for field in cloud.fields] == ["x", "y", "z", "pot"]
    values = np.frombuffer(bytes(cloud.data), "<f4").reshape(-1, 4)
    assert len(values) == cloud.width == made.search.reached.sum()
    assert values[values[:, 3].argmin(), :2] == pytest.approx([0.05, -0.95])
    at_goal = values[np.hypot(values[:, 0] - 2.55, values[:, 1] + 0.95).argmin()]
    assert at_goal[2] == pytest.approx(20.0)


def test_parameters_are_checked():
    with pytest.raises(ParameterError, match="default_tolerance"):
        planner(NavfnROS, room(), default_tolerance="much")
    planner(NavfnROS, room(), use_astar=True)
