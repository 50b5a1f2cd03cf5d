"""The module that scripts import as ``tf2_ros`` (http://wiki.ros.org/tf2_ros): buffer, listener and broadcasters of the script's node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini import tf
from rosmini.rospy.session import any_node, require_node
from rosmini.tf.buffer import BufferCore
from rosmini.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from rosmini.time import Duration

if TYPE_CHECKING:
    from rosmini.graph import Node

__all__ = [
    "Buffer",
    "BufferCore",
    "BufferInterface",
    "ConnectivityException",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
]


class Buffer(tf.Buffer):
    """The script's buffer; a :class:`TransformListener` fills it. What waits needs ``rospy.init_node`` first."""

    def __init__(self, cache_time: float | Duration | None = None, debug: bool = True) -> None:
        del debug  # the service ~tf2_frames, which nobody asks here
        super().__init__(None, cache_time)

    @property
    def node(self) -> Node:
        """The script's node."""
        return any_node()


BufferInterface = tf.Buffer


class TransformListener(tf.TransformListener):
    """Fills a buffer with what the script's node hears. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self,
        buffer: tf.Buffer,
        queue_size: int | None = None,
        buff_size: int = 65536,
        tcp_nodelay: bool = False,
    ) -> None:
        del buff_size, tcp_nodelay
        super().__init__(require_node("tf2_ros.TransformListener"), buffer, queue_size)


class TransformBroadcaster(tf.TransformBroadcaster):
    """Sends transforms that change. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self) -> None:
        super().__init__(require_node("tf2_ros.TransformBroadcaster"))


class StaticTransformBroadcaster(tf.StaticTransformBroadcaster):
    """Sends transforms that never change. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self) -> None:
        super().__init__(require_node("tf2_ros.StaticTransformBroadcaster"))


def __getattr__(name: str) -> Any:
    """Scripts get message types through this module too: ``tf2_ros.TransformStamped``."""
    if name in ("TransformStamped", "TFMessage"):
        from rosmini.msgs import message_class

        return message_class(
            "geometry_msgs/TransformStamped" if name == "TransformStamped" else "tf2_msgs/TFMessage"
        )
    raise AttributeError(f"module 'tf2_ros' has no attribute {name!r}")
