"""A graph with a local planner and a costmap on which the robot stands where a test says."""

from __future__ import annotations

import numpy as np

from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.nav_core import BaseLocalPlanner, pose_stamped


class FakeCostmap:
    """What a planner uses of `Costmap2DROS`: a rolling window of 3 m, free at first."""

    def __init__(self, node):
        self.node, self.buffer = node, Buffer(node)
        self.global_frame, self.base_frame = "odom", "base_footprint"
        self.grid = Costmap2D(60, 60, 0.05, (-1.5, -1.5))
        self.footprint = np.array([(-0.105, -0.105), (-0.105, 0.105), (0.041, 0.105), (0.041, -0.105)])
        self.pose = (0.0, 0.0, 0.0)

    def robot_pose(self):
        return pose_stamped("odom", self.node.now(), self.pose)


class LocalBench:
    """A local planner by its plugin's name, on a graph of its own."""

    def __init__(self, plugin, parameters):
        self.graph = Graph()
        self.node = self.graph.node("move_base")
        self.name = plugin.partition("/")[2]
        self.node.set_param(f"~{self.name}", dict(parameters))
        self.costmap = FakeCostmap(self.node)
        self.planner = BaseLocalPlanner.create(plugin)
        self.planner.initialize(self.name, self.costmap.buffer, self.costmap)
        self._odom = self.graph.node("robot").publisher("/odom", message_class("nav_msgs/Odometry"), queue_size=1)
        self.graph.run(0.1)

    def drive(self, x=0.0, theta=0.0):
        """Let the odometry say that the robot is this fast."""
        message = message_class("nav_msgs/Odometry")()
        message.twist.twist.linear.x, message.twist.twist.angular.z = x, theta
        self._odom.publish(message)
        self.graph.run(0.01)

    def plan(self, *points, frame="odom", heading=0.0):
        self.planner.set_plan([pose_stamped(frame, Time(0), (x, y, heading)) for x, y in points])

    def command(self):
        """The next command, ahead and turning."""
        twist = self.planner.compute_velocity_commands()
        return twist.linear.x, twist.angular.z

    def heard(self, topic, kind):
        """A list that gets the messages of a topic of the planner."""
        found = []
        listener = self.graph.node("listener_" + topic)
        listener.subscriber(f"/move_base/{self.name}/{topic}", message_class(kind), found.append)
        self.graph.run(0.1)
        return found
