"""The package's node, started as roslaunch starts it."""

from __future__ import annotations

from rosmini.core.plugins import Plugin
from rosmini.navigation.costmap_2d.node import Costmap2DNode

from .conftest import layers


def test_a_costmap_alone(stage):
    node = stage.graph.node("costmap_node")
    node.set_param(
        "~costmap",
        {"plugins": layers("inflation"), "global_frame": "odom", "rolling_window": True, "width": 2, "height": 2},
    )
    program = Costmap2DNode(node)
    assert program.costmap.grid.costs.shape == (40, 40)
    assert "/costmap_node/costmap/costmap" in node.publications
    assert issubclass(type(program.costmap.layers[0]), Plugin)
