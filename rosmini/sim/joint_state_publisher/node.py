"""`joint_state_publisher/joint_state_publisher` (http://wiki.ros.org/joint_state_publisher)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ParameterError
from rosmini.msgs import message_class
from rosmini.sim.robot_state_publisher import read_description

from .positions import Positions

if TYPE_CHECKING:
    from rosmini.core.graph import Node

GONE = {
    "use_gui": "the window with sliders is not in this package any more, but in joint_state_publisher_gui",
    "num_rows": "it belongs to the window with sliders, which is in joint_state_publisher_gui",
}


class JointStatePublisher:
    """Publishes `joint_states` (sensor_msgs/JointState) for a robot in `robot_description` without motors.

    Joints are at 0, or in the middle of their limits if these exclude 0. Parameters, private or else in the node's
    namespace: `rate` (10 Hz), `zeros` (positions by joint), `dependent_joints` (`parent`, `factor`, `offset` by joint),
    `use_mimic_tags`, `source_list` (topics whose positions are adopted), `delta` (change of free joints in each
    period), `publish_default_positions`, `publish_default_velocities`, `publish_default_efforts`.

    Raises:
        ParameterNotSet: there is no `robot_description`.
        ParameterError: a parameter has the wrong type.
        UrdfError: the description is invalid.

    """

    def __init__(self, node: Node) -> None:
        self.node = node
        for name, where in GONE.items():
            if self._parameter(name, None):  # Noetic's node ignores it, and launch files still set it
                node.logwarn(f"{node.name} has no parameter {name}: {where}")
        self.robot = read_description(node)
        self.positions = Positions(
            self.robot,
            zeros=self._parameter("zeros", {}, dict),
            dependent=self._parameter("dependent_joints", {}, dict),
            use_mimic=self._parameter("use_mimic_tags", True, bool),
        )
        self._defaults()
        self.delta = self._parameter("delta", 0.0, float)
        rate = self._parameter("rate", 10.0, float)
        if rate <= 0:
            raise ParameterError(f"{node.name}: rate is above 0 Hz, not {rate:g}")
        kind = message_class("sensor_msgs/JointState")
        for topic in self._parameter("source_list", [], list):
            node.subscriber(topic, kind, self._heard, numpy=False)
        self._message = kind
        self._publisher = node.publisher("joint_states", kind, queue_size=5)
        node.timer(1 / rate, lambda _: self._send())

    def __repr__(self) -> str:
        return f"<JointStatePublisher {self.node.name} of {self.robot.name}>"

    def set(self, **joints: float) -> None:
        """Set joint positions [rad or m], as the sliders of joint_state_publisher_gui do. Raises `UnknownJoint`."""
        for name, position in joints.items():
            self.robot.joint(name)
            self.positions.take(name, float(position), None, None)

    def _parameter(self, name: str, default: Any, expect: type | None = None) -> Any:
        """Return a private parameter, or else one in the node's namespace, or else `default`."""
        for key in (f"~{name}", name):
            if self.node.has_param(key):
                return self.node.get_param(key, expect=expect)
        return default

    def _defaults(self) -> None:
        for joint in self.positions.free.values():
            if not self._parameter("publish_default_positions", True, bool):
                joint.position = None
            if self._parameter("publish_default_velocities", False, bool):
                joint.velocity = 0.0
            if self._parameter("publish_default_efforts", False, bool):
                joint.effort = 0.0

    def _heard(self, state: Any) -> None:
        for i, name in enumerate(state.name):
            values = [
                float(each[i]) if i < len(each) else None for each in (state.position, state.velocity, state.effort)
            ]
            self.positions.take(name, *values)

    def _send(self) -> None:
        if self.delta > 0:
            self.positions.move(self.delta)
        rows = self.positions.table()
        if not rows:
            return
        message = self._message()
        message.header.stamp = self.node.now()
        message.name = [row[0] for row in rows]
        for column, name in enumerate(("position", "velocity", "effort"), start=1):
            values = [row[column] for row in rows]
            if any(value is not None for value in values):
                setattr(message, name, [0.0 if value is None else float(value) for value in values])
        self._publisher.publish(message)
