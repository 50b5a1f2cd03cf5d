"""`turtlesim/mimic`: one turtle imitates another.

It subscribes to poses on `input/pose` and publishes their velocities on `output/cmd_vel`; remap both:
`rosrun turtlesim mimic input:=turtle1 output:=turtle2`.
"""

from __future__ import annotations

from typing import Any

from rosmini.core.graph import Node
from rosmini.msgs import message_class


class Mimic:
    """The node `turtle_mimic`: publishes the velocities in one turtle's poses as commands for another."""

    node_name = "turtle_mimic"

    def __init__(self, node: Node) -> None:
        self._twist = message_class("geometry_msgs/Twist")()
        self._commands = node.publisher(f"{node.resolve('output')}/cmd_vel", type(self._twist), queue_size=1)
        node.subscriber(f"{node.resolve('input')}/pose", message_class("turtlesim/Pose"), self._heard, queue_size=1)

    def _heard(self, pose: Any) -> None:
        self._twist.linear.x, self._twist.angular.z = pose.linear_velocity, pose.angular_velocity
        self._commands.publish(self._twist)
