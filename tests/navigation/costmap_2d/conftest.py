"""A graph with a map, a robot's transforms and a scan, without a simulator."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener
from rosmini.core.tf.rigid import from_yaw
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap_ros import Costmap2DROS

ROBOT = {"robot_radius": 0.1, "footprint_padding": 0.0}
WINDOW = {"global_frame": "odom", "rolling_window": True, "width": 4, "height": 4, "resolution": 0.1, **ROBOT}
SOURCE = {"data_type": "LaserScan", "topic": "scan", "marking": True, "clearing": True}


class Stage:
    """Who drives a costmap in tests: a robot at `pose` in odom and map, with a laser at its centre."""

    def __init__(self, graph):
        self.graph = graph
        self.pose = (1.03, 1.04, 0.0)
        self.node = graph.node("move_base")
        self.robot = graph.node("robot")
        self.buffer = Buffer(self.node)
        TransformListener(self.node, self.buffer)
        self.fixed = StaticTransformBroadcaster(self.robot)
        self.fixed.send("map", "odom", (0.0, 0.0, 0.0))
        self.moving = TransformBroadcaster(self.robot)
        self.scans = self.robot.publisher("scan", message_class("sensor_msgs/LaserScan"))
        self.tells = self.robot.timer(0.02, lambda _: self.moving.send_rigid("odom", "base_link", from_yaw(*self.pose)))

    def publish_map(self, occupancy, resolution=0.1, origin=(0.0, 0.0)):
        """Latch a map (h, w)."""
        kind = message_class("nav_msgs/OccupancyGrid")
        publisher = self.graph.node("map_server").publisher("map", kind, latch=True)
        publisher.expect_nobody()
        publisher.publish(map_message(occupancy, resolution, origin))
        return publisher

    def costmap(self, name="costmap", **parameters):
        """A costmap with these parameters, as nested dictionaries."""
        self.node.set_param(f"~{name}", parameters)
        return Costmap2DROS(name, self.buffer, self.node)

    def scan(self, ranges, *, seconds=0.2, frame="base_link", **fields):
        """Publish a scan all around, and let time pass until it is taken."""
        self.graph.run(0.05)
        message = message_class("sensor_msgs/LaserScan")()
        message.header.frame_id, message.header.stamp = frame, self.robot.now()
        message.angle_min, message.angle_increment = 0.0, 2 * np.pi / max(len(ranges), 1)
        message.range_min, message.range_max = 0.1, 3.5
        message.ranges = list(ranges)
        for field, value in fields.items():
            setattr(message, field, value)
        self.scans.publish(message)
        self.graph.run(seconds)


def map_message(occupancy, resolution=0.1, origin=(0.0, 0.0)):
    """A map (h, w) as a message."""
    cells = np.asarray(occupancy, dtype=np.int8)
    message = message_class("nav_msgs/OccupancyGrid")()
    message.header.frame_id = "map"
    message.info.resolution = resolution
    message.info.height, message.info.width = cells.shape
    message.info.origin.position.x, message.info.origin.position.y = origin
    message.data = cells.ravel()
    return message


@pytest.fixture
def stage():
    with Graph() as graph:
        yield Stage(graph)


def layers(*names):
    """The parameter `plugins`."""
    kinds = {"static": "StaticLayer", "obstacles": "ObstacleLayer", "voxels": "VoxelLayer"}
    return [{"name": name, "type": f"costmap_2d::{kinds.get(name, 'InflationLayer')}"} for name in names]
