"""A costmap for planners alone: a grid that stays as it is, on a node."""

from __future__ import annotations

import numpy as np

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.nav_core import pose_stamped


class FakeCostmap:
    """What planners ask of `Costmap2DROS`."""

    global_frame = "map"
    name = "global_costmap"

    def __init__(self, node, costs, resolution=0.1, origin=(-1.0, -2.0)):
        self.node = node
        self.grid = Costmap2D.of(costs, resolution, origin)
        self.footprint = np.array([[0.15, 0.15], [-0.15, 0.15], [-0.15, -0.15], [0.15, -0.15]])


def planner(cls, costs, name=None, **parameters):
    """A planner of this class on a graph of its own, the graph, and messages of topics as they come."""
    graph = Graph()
    name = name or cls.plugin_name.rpartition("/")[2]
    node = graph.node("move_base")
    for key, value in parameters.items():
        node.set_param(f"~{name}/{key}", value)
    made = cls()
    made.initialize(name, FakeCostmap(node, np.array(costs, np.uint8)))
    heard = {}
    watcher = graph.node("watcher")
    for topic, kind in (
        ("plan", "nav_msgs/Path"),
        ("potential", "sensor_msgs/PointCloud2" if name == "NavfnROS" else "nav_msgs/OccupancyGrid"),
    ):
        watcher.subscriber(f"/move_base/{name}/{topic}", message_class(kind), heard.setdefault(topic, []).append)
    graph.run(0.1)
    return made, graph, heard


def pose(x, y, yaw=0.0, frame="map"):
    return pose_stamped(frame, Time(0), (x, y, yaw))


def points(plan):
    return np.array([(each.pose.position.x, each.pose.position.y) for each in plan])
