from types import SimpleNamespace

import pytest

from rosmini.core.time import Time
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.nav_core import RecoveryBehavior, TransformMissing, pose_stamped


class FakeLayer:
    def __init__(self, name):
        self.name, self.grid, self.cleared = name, Costmap2D(100, 100, 0.1, (-5.0, -5.0)), []

    def clear_area(self, *area):
        self.cleared.append(area)


class FakeCostmap:
    """As much of a Costmap2DROS as a recovery behaviour uses."""

    def __init__(self, node, name, layers=("static_layer", "obstacle_layer"), pose=(1.0, 2.0, 0.0)):
        self.node, self.name, self.pose, self.updates = node, name, pose, 0
        self.layers = [*map(FakeLayer, layers), SimpleNamespace(name="inflation_layer")]

    def robot_pose(self):
        if self.pose is None:
            raise TransformMissing("nobody says where the robot is")
        return pose_stamped("map", Time(), self.pose)

    def update(self):
        self.updates += 1


def made(node, name="reset", **parameters):
    node.set_param(f"~{name}", parameters)
    costmaps = FakeCostmap(node, "global_costmap"), FakeCostmap(node, "local_costmap")
    behavior = RecoveryBehavior.create("clear_costmap_recovery/ClearCostmapRecovery")
    behavior.initialize(name, None, *costmaps)
    return behavior, *costmaps


def cleared(costmap):
    return [(layer.name, *area) for layer in costmap.layers[:-1] for area in layer.cleared]


def test_all_but_a_square_is_cleared_in_the_named_layers(node):
    behavior, *costmaps = made(node, layer_names=["obstacle_layer"], reset_distance=3.0)
    behavior.run_behavior()
    for costmap in costmaps:
        assert cleared(costmap) == [("obstacle_layer", 45, 55, 75, 85, False)]
        assert costmap.updates == 0


@pytest.mark.parametrize(("maps", "count"), [("global", (1, 0)), ("local", (0, 1)), ("both", (1, 1))])
def test_affected_maps(node, maps, count):
    behavior, *costmaps = made(node, layer_names=["obstacle_layer"], affected_maps=maps, force_updating=True)
    behavior.run_behavior()
    assert tuple(len(cleared(costmap)) for costmap in costmaps) == count
    assert tuple(costmap.updates for costmap in costmaps) == count


def test_a_wrong_map_means_both(node, capsys):
    behavior, *_ = made(node, affected_maps="glocal")
    assert len(behavior.costmaps()) == 2
    assert "Wrong value for affected_maps parameter: 'glocal'" in capsys.readouterr().err


def test_the_default_clears_nothing_of_a_costmap_without_obstacles_and_says_so(node, capsys):
    behavior, costmap, _ = made(node)
    said = capsys.readouterr().err
    assert "reset will clear nothing" in said
    assert "obstacle_layer" in said
    behavior.run_behavior()
    assert cleared(costmap) == []


def test_a_layer_without_costs_of_its_own(node, capsys):
    behavior, *_ = made(node, layer_names=["inflation_layer"])
    behavior.run_behavior()
    assert "Layer inflation_layer is not derived from costmap_2d::CostmapLayer" in capsys.readouterr().err


def test_nobody_knows_where_the_robot_is(node, capsys):
    behavior, costmap, local = made(node, layer_names=["obstacle_layer"])
    costmap.pose = None
    behavior.run_behavior()
    assert (cleared(costmap), len(cleared(local))) == ([], 1)
    assert "Cannot clear map because pose cannot be retrieved" in capsys.readouterr().err
