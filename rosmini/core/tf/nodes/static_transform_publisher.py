"""`static_transform_publisher` of tf2_ros and of tf (http://wiki.ros.org/tf#static_transform_publisher)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.errors import ScriptError
from rosmini.core.tf.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from rosmini.core.tf.errors import InvalidArgumentException
from rosmini.core.tf.rigid import Rigid, from_rpy, rigid
from rosmini.core.time import Duration

if TYPE_CHECKING:
    from rosmini.core.graph import Node

USAGE = """Usage: static_transform_publisher x y z qx qy qz qw frame_id child_frame_id{period}
   or: static_transform_publisher x y z yaw pitch roll frame_id child_frame_id{period}
x, y, z in metres, angles in radians: where child_frame_id is in frame_id."""


def parse(arguments: tuple[str, ...], period: str = "") -> tuple[str, str, Rigid]:
    """Return frame, child and transform from the arguments: three metres, then yaw, pitch, roll or a quaternion.

    Raises `ScriptError` if they are invalid.
    """
    usage = USAGE.format(period=period)
    if len(arguments) not in (8, 9):
        raise ScriptError(
            f"static_transform_publisher got {len(arguments)} arguments before the period, if any.\n{usage}"
        )
    *words, frame, child = arguments
    try:
        numbers = [float(word) for word in words]
    except ValueError as error:
        raise ScriptError(f"static_transform_publisher: {error}.\n{usage}") from error
    if frame == child:
        raise ScriptError(
            f"frame_id and child_frame_id are the same ({frame}): a frame is where it is in itself.\n{usage}"
        )
    if len(numbers) == 6:
        yaw, pitch, roll = numbers[3:]
        return frame, child, from_rpy(numbers[:3], roll, pitch, yaw)
    try:
        return frame, child, rigid(numbers[:3], numbers[3:])
    except InvalidArgumentException as error:
        raise ScriptError(f"static_transform_publisher: {error}\n{usage}") from error


class StaticTransformPublisher:
    """`tf2_ros/static_transform_publisher`: one transform, latched on `/tf_static`."""

    def __init__(self, node: Node, *arguments: str) -> None:
        self.frame, self.child, self.transform = parse(arguments)
        self.broadcaster = StaticTransformBroadcaster(node)
        self.broadcaster.send_rigid(self.frame, self.child, self.transform)
        node.loginfo(f"Spinning until killed publishing {self.frame} to {self.child}")


class RepeatingTransformPublisher:
    """`tf/static_transform_publisher`: one transform, sent periodically on `/tf`, stamped one period ahead."""

    def __init__(self, node: Node, *arguments: str) -> None:
        usage = " period_in_ms"
        self.frame, self.child, self.transform = parse(arguments[:-1], usage)
        try:
            self.period = Duration.from_sec(float(arguments[-1]) / 1e3)
        except ValueError as error:
            raise ScriptError(
                f"static_transform_publisher: {error} as the period.\n{USAGE.format(period=usage)}"
            ) from error
        if self.period.to_nsec() <= 0:
            raise ScriptError(f"a period of {arguments[-1]} ms is none.\n{USAGE.format(period=usage)}")
        self.node = node
        self.broadcaster = TransformBroadcaster(node)
        self.timer = node.timer(self.period, lambda _event: self.send())

    def send(self) -> None:
        """Send the transform now."""
        self.broadcaster.send_rigid(self.frame, self.child, self.transform, self.node.now() + self.period)
