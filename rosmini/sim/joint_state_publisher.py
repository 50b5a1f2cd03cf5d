"""`joint_state_publisher/joint_state_publisher` (http://wiki.ros.org/joint_state_publisher)."""

from __future__ import annotations

from typing import Any

from rosmini.core.errors import ParameterError
from rosmini.core.graph import Node
from rosmini.msgs import message_class
from rosmini.sim.robot_state_publisher.description import read_description


class JointStatePublisher:
    """Publishes `joint_states` (sensor_msgs/JointState) for a robot in `robot_description` without motors.

    Joints are at 0, or in the middle of their limits if these exclude 0. The parameters `rate` (10 Hz) and `zeros`
    (positions by joint) are private or in the node's namespace. Joints that mimic others are left to
    robot_state_publisher.

    Raises:
        ParameterNotSet: there is no `robot_description`.
        ParameterError: a parameter has the wrong type.
        UrdfError: the description is invalid.

    """

    def __init__(self, node: Node) -> None:
        self.node = node
        zeros = self._parameter("zeros", {}, dict)
        moving = [joint for joint in read_description(node).joints.values() if joint.moves and joint.mimic is None]
        self.positions = {joint.name: float(zeros.get(joint.name, joint.rest)) for joint in moving}
        rate = self._parameter("rate", 10.0, float)
        if rate <= 0:
            raise ParameterError(f"{node.name}: rate is above 0 Hz, not {rate:g}")
        self._message = message_class("sensor_msgs/JointState")
        self._publisher = node.publisher("joint_states", self._message, queue_size=5)
        node.timer(1 / rate, lambda _: self._send())

    def _parameter(self, name: str, default: Any, expect: type) -> Any:
        """Return a private parameter, or else one in the node's namespace, or else `default`."""
        for key in (f"~{name}", name):
            if self.node.has_param(key):
                return self.node.get_param(key, expect=expect)
        return default

    def _send(self) -> None:
        message = self._message(name=list(self.positions), position=list(self.positions.values()))
        message.header.stamp = self.node.now()
        self._publisher.publish(message)
