"""`robot_state_publisher/robot_state_publisher` (http://wiki.ros.org/robot_state_publisher)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from rosmini.core.errors import nearest
from rosmini.core.graph import Node
from rosmini.core.parameters import Parameters, parameter
from rosmini.core.tf.broadcaster import StaticTransformBroadcaster, TransformBroadcaster, tf_prefix
from rosmini.core.tf.messages import to_stamped
from rosmini.msgs import message_class

from .chain import Chain, Sent
from .description import NAME, read_description

SECOND_NS = 1_000_000_000
OLD_NS = 30 * SECOND_NS
"""Maximum age of joint states [ns] without a warning."""
AHEAD_NS = SECOND_NS // 2
"""Offset of the stamps of fixed joints on `/tf` into the future [ns]."""


@dataclass(frozen=True)
class RobotStatePublisherParameters(Parameters):
    """Parameters of `robot_state_publisher`."""

    allowed: ClassVar[tuple[str, ...]] = (NAME, "tf_prefix")

    publish_frequency: float = parameter(50.0, "maximum rate at which the transform of a joint is published", unit="Hz")
    use_tf_static: bool = parameter(True, "publish fixed joints once, on /tf_static, not repeatedly on /tf")
    ignore_timestamp: bool = parameter(False, "publish for every message on joint_states, however soon after the last")


class RobotStatePublisher:
    """Publishes transforms of the links of the robot in `robot_description`, from `joint_states`.

    Fixed joints are on `/tf_static`, moving ones on `/tf` with the stamp of the joint states; a joint that
    mimics another follows it. Frames get the nearest `tf_prefix`, searched upwards.

    Raises:
        ParameterNotSet: there is no `robot_description`.
        UrdfError: the description is invalid.

    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self.parameters = RobotStatePublisherParameters.read(node)
        self.robot = read_description(node)
        self.chain = Chain(self.robot)
        self.prefix = tf_prefix(node)
        self.interval_ns = round(SECOND_NS / max(self.parameters.publish_frequency, 1.0))
        self._last_stamps: dict[str, int] = {}
        self._unknown: set[str] = set()
        self._last_ns = 0
        for doubt in self.robot.notes:
            node.logwarn(doubt)
        for name in self.chain.floating:
            node.loginfo(f"Floating joint {name}: joint_states cannot contain its pose, so no transform is published")
        self._broadcaster = TransformBroadcaster(node, self.prefix)
        period = self.interval_ns / SECOND_NS
        if self.parameters.use_tf_static:
            static = StaticTransformBroadcaster(node, self.prefix)
            node.timer(period, lambda _: self._send(static, self.chain.fixed, node.clock.now_ns()), oneshot=True)
        else:
            node.timer(period, lambda _: self._send_fixed())
        node.subscriber("joint_states", message_class("sensor_msgs/JointState"), self._heard, queue_size=1, numpy=False)

    def _send(self, broadcaster: TransformBroadcaster, transforms: list[Sent], stamp_ns: int) -> None:
        if transforms:
            broadcaster.sendTransform([to_stamped(*each, stamp_ns) for each in transforms])

    def _send_fixed(self) -> None:
        self._send(self._broadcaster, self.chain.fixed, self.node.clock.now_ns() + AHEAD_NS)

    def _heard(self, state: Any) -> None:
        """Publish the transforms of a message's joints, unless they were published a moment ago."""
        names, positions = list(state.name), list(state.position)
        if len(names) != len(positions):
            if positions:
                self.node.logerr(
                    f"ignored a JointState with {len(names)} names and {len(positions)} positions: as many are needed"
                )
            elif names:
                self.node.logwarn(f"ignored a JointState of {names[0]!r} and others without positions", throttle=300.0)
            return
        now, stamp = self.node.clock.now_ns(), state.header.stamp.to_nsec()
        if self._last_ns > now:
            self.node.logwarn("Time moved backwards, as a clock or a bag that starts again: telling all joints again")
            self._last_stamps.clear()
        self._last_ns = now
        if stamp + OLD_NS < now:
            self.node.logwarn(f"a JointState is {(now - stamp) / SECOND_NS:.1f} seconds old", throttle=10.0)
        last = min((self._last_stamps.get(name, 0) for name in names), default=now)
        if not self.parameters.ignore_timestamp and stamp < min(last, now) + self.interval_ns:
            return
        for name in names:
            if name not in self.robot.joints and name not in self._unknown:
                self._unknown.add(name)
                hint = nearest(name, self.robot.joints)
                more = f": {hint}" if hint else ""
                self.node.logwarn(f"joint_states contains {name}, which {self.robot.name!r} does not have{more}")
        self._send(self._broadcaster, self.chain.transforms(dict(zip(names, positions, strict=True))), stamp)
        self._last_stamps.update(dict.fromkeys(names, stamp))
