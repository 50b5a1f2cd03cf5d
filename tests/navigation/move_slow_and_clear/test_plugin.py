from dataclasses import dataclass

import pytest

from rosmini.core.dynamic_reconfigure import Server
from rosmini.core.parameters import Parameters, parameter
from rosmini.navigation.nav_core import RecoveryBehavior
from tests.navigation.clear_costmap_recovery.test_plugin import FakeCostmap


@dataclass(frozen=True)
class Limits(Parameters):
    max_vel_trans: float = parameter(0.55, "speed")
    max_vel_theta: float = parameter(1.2, "turn")


@pytest.fixture
def limits(node):
    held = {}
    Server(node, Limits, lambda config, _: held.update(config) or config, namespace="~DWAPlannerROS/")
    return held


def made(node, **parameters):
    node.set_param("~slow", parameters)
    costmaps = FakeCostmap(node, "global_costmap"), FakeCostmap(node, "local_costmap")
    behavior = RecoveryBehavior.create("move_slow_and_clear/MoveSlowAndClear")
    behavior.initialize("slow", None, *costmaps)
    return behavior, *costmaps


def test_it_clears_and_limits_until_the_robot_has_left(node, limits):
    behavior, costmap, local = made(node)
    behavior.run_behavior()
    assert [each.cleared for each in costmap.layers[:-1]] == [[], [(55, 65, 65, 75, True)]]
    assert len(local.layers[1].cleared) == 1
    node.graph.run(1.0)
    assert (limits["max_vel_trans"], limits["max_vel_theta"]) == (0.25, 0.45)
    costmap.pose = (1.2, 2.0, 0.0)
    behavior.run_behavior()
    node.graph.run(1.0)
    costmap.pose = (1.4, 2.0, 0.0)
    node.graph.run(1.0)
    assert limits["max_vel_trans"] == 0.25, "it was stuck again at 1.2"
    costmap.pose = (1.5, 2.0, 0.0)
    node.graph.run(1.0)
    assert (limits["max_vel_trans"], limits["max_vel_theta"]) == (0.55, 1.2)


def test_a_planner_of_another_name(node, limits, capsys):
    behavior, *_ = made(node, planner_namespace="TebLocalPlannerROS")
    behavior.run_behavior()
    said = capsys.readouterr().err
    assert "The planner TebLocalPlannerROS does not have the parameter" in said
    assert limits["max_vel_trans"] == 0.55


def test_a_planner_without_dynamic_reconfigure(node, capsys):
    node.set_param("~DWAPlannerROS", {"max_vel_trans": 0.5, "max_vel_theta": 1.0})
    behavior, *_ = made(node)
    behavior.run_behavior()
    assert "Something went wrong in the service call to dynamic_reconfigure" in capsys.readouterr().err


def test_nobody_knows_where_the_robot_is(node, limits, capsys):
    behavior, costmap, _ = made(node)
    costmap.pose = None
    behavior.run_behavior()
    assert "pose cannot be retrieved" in capsys.readouterr().err
    assert limits["max_vel_trans"] == 0.55
