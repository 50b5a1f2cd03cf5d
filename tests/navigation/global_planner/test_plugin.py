"""`global_planner/GlobalPlanner` on a graph."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.core.dynamic_reconfigure import Client
from rosmini.core.errors import ParameterError
from rosmini.navigation.global_planner.plugin import GlobalPlanner, GlobalPlannerConfig
from rosmini.navigation.global_planner.search import GlobalAStar, GlobalDijkstra
from rosmini.navigation.nav_core import NoPath

from ..fake_costmap import planner, points, pose


def room() -> np.ndarray:
    costs = np.zeros((30, 40), np.uint8)
    costs[:22, 18:20] = 254
    return costs


def test_names_types_defaults_and_ranges_are_those_of_the_real_cfg():
    rows = [row[:4] for row in GlobalPlannerConfig.table("")]
    assert rows == [
        ("lethal_cost", "int", "253", "1 ... 255"),
        ("neutral_cost", "int", "50", "1 ... 255"),
        ("cost_factor", "float", "3.0", "0.01 ... 5.0"),
        ("publish_potential", "bool", "True", ""),
        ("orientation_mode", "int", "1", "0 ... 6"),
        ("orientation_window_size", "int", "1", "1 ... 255"),
    ]


@pytest.mark.parametrize("use_dijkstra", [True, False])
@pytest.mark.parametrize("use_grid_path", [True, False])
@pytest.mark.parametrize("use_quadratic", [True, False])
def test_a_plan_begins_at_the_robot_and_ends_at_the_goal_in_each_form(use_dijkstra, use_grid_path, use_quadratic):
    forms = {"use_dijkstra": use_dijkstra, "use_grid_path": use_grid_path, "use_quadratic": use_quadratic}
    made, graph, heard = planner(GlobalPlanner, room(), **forms)
    plan = made.make_plan(pose(0.03, -1.02), pose(2.5, -1.5, 1.0))
    graph.run(0.1)
    found = points(plan)
    assert isinstance(made.search, GlobalDijkstra if use_dijkstra else GlobalAStar)
    assert found[0] == pytest.approx([0.03, -1.02]) and found[-1] == pytest.approx([2.5, -1.5])
    assert points(heard["plan"][-1].poses) == pytest.approx(found)
    for x, y in found:
        assert made.grid.cost(*made.grid.world_to_map(x, y)) < 253
    potential = heard["potential"][-1]
    assert (potential.info.width, potential.info.height) == (40, 30)
    values = np.array(potential.data).reshape(30, 40)
    assert values.max() == 100 and values[5, 18] == -1 and 0 <= values[9, 10] <= 1


def test_headings_point_along_the_path_and_the_last_is_the_goal_s():
    made, _, _ = planner(GlobalPlanner, np.zeros((30, 40)))
    plan = made.make_plan(pose(0.0, -1.0), pose(2.0, -1.0, 1.0))
    yaws = [2 * math.atan2(each.pose.orientation.z, each.pose.orientation.w) for each in plan]
    # Between cells, as here, the first and the last half a cell may lead aside.
    assert yaws[2:-2] == pytest.approx([0.0] * len(yaws[2:-2]), abs=0.1)
    assert yaws[-1] == pytest.approx(1.0)


def test_old_navfn_behavior_puts_points_half_a_cell_to_the_lower_left():
    made, _, _ = planner(GlobalPlanner, room(), old_navfn_behavior=True)
    assert points(made.make_plan(pose(0.03, -1.02), pose(2.5, -1.5)))[0] == pytest.approx([0.0, -1.1])


def test_the_outermost_cells_are_closed_unless_outline_map_is_false():
    costs = np.full((10, 40), 254)
    costs[0] = 0
    goal = pose(2.05, -1.95)
    assert planner(GlobalPlanner, costs, outline_map=False)[0].make_plan(pose(0.05, -1.95), goal)
    with pytest.raises(Exception, match="shut in"):
        planner(GlobalPlanner, costs)[0].make_plan(pose(0.05, -1.95), goal)


def test_costs_are_changed_while_it_runs():
    costs = room()
    costs[22:, 18:20] = 200
    made, graph, heard = planner(GlobalPlanner, costs)
    assert made.make_plan(pose(0.0, 0.0), pose(2.5, 0.0))
    client = Client(graph.node("tuner"), "/move_base/GlobalPlanner")
    client.update_configuration({"lethal_cost": 150, "publish_potential": False})
    graph.run(0.1)
    before = len(heard["potential"])
    with pytest.raises(NoPath, match="no path leads from the start"):
        made.make_plan(pose(0.0, 0.0), pose(2.5, 0.0))
    graph.run(0.1)
    assert len(heard["potential"]) == before == 1
    assert heard["plan"][-1].poses == []


def test_parameters_out_of_range_are_limited(capsys):
    made, _, _ = planner(GlobalPlanner, room(), orientation_mode=7, neutral_cost=66.0, cost_factor=9)
    assert (made.config["orientation_mode"], made.config["neutral_cost"], made.config["cost_factor"]) == (6, 66, 5.0)
    said = capsys.readouterr().err
    assert "/move_base/GlobalPlanner/orientation_mode is 7" in said
    assert "1 ... 255" not in said
    with pytest.raises(ParameterError, match="orientation_mode"):
        planner(GlobalPlanner, room(), orientation_mode="forward")
