"""Broadcasters of transforms: repeatedly on `/tf`, and latched on `/tf_static` (http://wiki.ros.org/tf2_ros)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rosmini.core.time import Time
from rosmini.msgs import message_class

from .messages import to_stamped
from .rigid import Rigid, rigid

if TYPE_CHECKING:
    from rosmini.core.graph import Node


def resolve(prefix: str, frame: str) -> str:
    """Return a frame's name with a `tf_prefix`: `robot1/base_link`.

    A name that begins with `/` gets no prefix (http://wiki.ros.org/geometry/CoordinateFrameConventions).

    >>> resolve("robot1", "base_link"), resolve("robot1", "/map"), resolve("", "odom")
    ('robot1/base_link', 'map', 'odom')
    """
    if frame.startswith("/"):
        return frame[1:]
    prefix = prefix.strip("/")
    return f"{prefix}/{frame}" if prefix else frame


def tf_prefix(node: Node) -> str:
    """Return the value of the parameter `tf_prefix`, searched upwards from a node; empty if it is not set."""
    name = node.search_param("tf_prefix")
    return "" if name is None else str(node.get_param(name)).strip("/")


class TransformBroadcaster:
    """Sends changing transforms on `/tf`.

    With a `prefix`, names that do not begin with `/` get it; see `resolve`.
    """

    TOPIC = "/tf"
    LATCH = False

    def __init__(self, node: Node, prefix: str = "", queue_size: int = 100) -> None:
        self.node = node
        self.prefix = prefix
        self._message = message_class("tf2_msgs/TFMessage")
        self._publisher = node.publisher(self.TOPIC, self._message, queue_size=queue_size, latch=self.LATCH)

    def send(
        self,
        parent: str,
        child: str,
        translation: Sequence[float] = (0.0, 0.0, 0.0),
        rotation: Sequence[float] = (0.0, 0.0, 0.0, 1.0),
        stamp: Time | None = None,
    ) -> None:
        """Send the pose of `child` in `parent`: translation [m], quaternion (x, y, z, w), and time (now by default).

        Raises `InvalidArgumentException` for a quaternion of length 0.
        """
        self.send_rigid(parent, child, rigid(translation, rotation), stamp)

    def send_rigid(self, parent: str, child: str, transform: Rigid, stamp: Time | None = None) -> None:
        """Send the pose of `child` in `parent`, given as seven numbers, at the time `stamp` (now by default)."""
        when = self.node.clock.now_ns() if stamp is None else stamp.to_nsec()
        self.sendTransform(to_stamped(parent, child, transform, when))

    def sendTransform(self, transform: Any) -> None:
        """Send a `geometry_msgs/TransformStamped`, or a list of them in one message.

        With a `prefix`, this changes the names of frames in the given messages.
        """
        several = list(transform) if isinstance(transform, (list, tuple)) else [transform]
        if self.prefix:
            for one in several:
                one.header.frame_id = resolve(self.prefix, one.header.frame_id)
                one.child_frame_id = resolve(self.prefix, one.child_frame_id)
        self._send(several)

    def _send(self, several: list[Any]) -> None:
        self._publisher.publish(self._message(transforms=several))


class StaticTransformBroadcaster(TransformBroadcaster):
    """Sends constant transforms on `/tf_static`, latched: a late subscriber gets the latest one of each child frame."""

    TOPIC = "/tf_static"
    LATCH = True

    def __init__(self, node: Node, prefix: str = "") -> None:
        super().__init__(node, prefix)
        self._sent: dict[str, Any] = {}

    def _send(self, several: list[Any]) -> None:
        for one in several:
            self._sent[one.child_frame_id] = one
        super()._send(list(self._sent.values()))
