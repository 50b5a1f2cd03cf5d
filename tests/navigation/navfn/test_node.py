"""A planner and its costmap as a node: `navfn/navfn_node` and `global_planner/planner`."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.msgs import message_class, service_class
from rosmini.navigation.global_planner.node import Planner
from rosmini.navigation.navfn.node import PlannerNode

from ..costmap_2d.conftest import Stage, layers
from ..fake_costmap import points, pose


@pytest.mark.parametrize(("kind", "name"), [(PlannerNode, "navfn_planner"), (Planner, "planner")])
def test_it_plans_on_its_own_costmap(kind, name):
    occupancy = np.zeros((40, 60), np.int8)
    occupancy[:30, 30] = 100
    with Graph() as graph:
        stage = Stage(graph)
        stage.publish_map(occupancy)
        parameters = {
            "plugins": layers("static", "inflation"),
            "robot_radius": 0.15,
            "inflation": {"inflation_radius": 0.4},
        }
        stage.node.set_param("~costmap", parameters)
        made = kind(stage.node)
        graph.run(0.5)
        asker, plans = graph.node("asker"), []
        asker.subscriber(f"/move_base/{name}/plan", message_class("nav_msgs/Path"), plans.append)
        make_plan = asker.service_client("/move_base/make_plan", service_class("navfn/MakeNavPlan"))
        answer = make_plan(start=pose(1.0, 1.0), goal=pose(5.0, 1.0, frame="nowhere"))
        assert (answer.plan_found, answer.error_message) == (1, "")
        found = points(answer.path)
        assert found[-1] == pytest.approx([5.0, 1.0]) and found[:, 1].max() > 3.0
        grid = made.costmap.grid
        assert max(grid.cost(*grid.world_to_map(x, y)) for x, y in found) < 253
        refused = make_plan(start=pose(1.0, 1.0), goal=pose(3.05, 1.0))
        assert refused.plan_found == 0 and "its cell has the cost 254" in refused.error_message
        goals = asker.publisher("/move_base/goal", message_class("geometry_msgs/PoseStamped"))
        graph.run(0.1)
        goals.publish(pose(5.0, 1.0))
        graph.run(0.3)
        # The robot stands at (1.03, 1.04).
        assert points(plans[-1].poses)[0] == pytest.approx([1.03, 1.04], abs=0.051)
