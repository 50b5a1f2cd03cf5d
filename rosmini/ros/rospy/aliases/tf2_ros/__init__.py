"""The module ``tf2_ros`` (http://wiki.ros.org/tf2_ros): buffer, listener and broadcasters of the script's node."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from rosmini.core import tf
from rosmini.core.graph.scheduler import CALL_TICKS
from rosmini.core.tf.buffer import BufferCore
from rosmini.core.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from rosmini.ros.rospy.session import any_node, require_node

from . import buffer_interface
from .buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)

if TYPE_CHECKING:
    from rosmini.core.graph import Node
    from rosmini.core.time import Duration, Time

__all__ = [
    "Buffer",
    "BufferCore",
    "BufferInterface",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "buffer_interface",
    "convert",
]

buffer = static_transform_broadcaster = transform_broadcaster = transform_listener = sys.modules[__name__]

_TYPES = {
    "Header": "std_msgs/Header",
    "TFMessage": "tf2_msgs/TFMessage",
    "TransformStamped": "geometry_msgs/TransformStamped",
}


class Buffer(tf.Buffer, BufferInterface):
    """The script's buffer, filled by a :class:`TransformListener`; waiting needs ``rospy.init_node`` first."""

    transform = BufferInterface.transform
    transform_full = BufferInterface.transform_full

    def __init__(self, cache_time: float | Duration | None = None, debug: bool = True) -> None:
        del debug  # the service ~tf2_frames, which nobody asks here
        BufferInterface.__init__(self)
        tf.Buffer.__init__(self, None, cache_time)

    @property
    def node(self) -> Node:
        """The script's node."""
        return any_node()

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Time) -> Any:
        """Like :meth:`rosmini.core.tf.BufferCore.lookup_transform_core`, but a polling loop consumes graph time."""
        any_node().scheduler.charge(CALL_TICKS)
        return super().lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Time, source_frame: str, source_time: Time, fixed_frame: str
    ) -> Any:
        """Like :meth:`rosmini.core.tf.BufferCore.lookup_transform_full_core`."""
        any_node().scheduler.charge(CALL_TICKS)
        return super().lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)


class TransformBroadcaster(tf.TransformBroadcaster):
    """Sends transforms that change. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self) -> None:
        super().__init__(require_node("tf2_ros.TransformBroadcaster"))


class StaticTransformBroadcaster(tf.StaticTransformBroadcaster):
    """Sends transforms that never change. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self) -> None:
        super().__init__(require_node("tf2_ros.StaticTransformBroadcaster"))


class TransformListener(tf.TransformListener):
    """Fills a buffer with transforms that the script's node gets. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self, buffer: tf.Buffer, queue_size: int | None = None, buff_size: int = 65536, tcp_nodelay: bool = False
    ) -> None:
        del buff_size, tcp_nodelay
        super().__init__(require_node("tf2_ros.TransformListener"), buffer, queue_size)


def __getattr__(name: str) -> Any:
    """Return a message type: scripts also import them from here, such as ``tf2_ros.TransformStamped``."""
    if name in _TYPES:
        from rosmini.msgs import message_class

        return message_class(_TYPES[name])
    hint = ": keep a tf2_ros.Buffer with a TransformListener instead" if name == "BufferClient" else ""
    raise AttributeError(f"module 'tf2_ros' has no attribute {name!r}{hint}")
