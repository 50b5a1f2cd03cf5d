"""``tf2_ros.buffer``: the buffer of the script's node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini import tf
from rosmini.rospy.session import any_node

from .buffer_interface import BufferInterface

if TYPE_CHECKING:
    from rosmini.graph import Node
    from rosmini.time import Duration

__all__ = ["Buffer"]


class Buffer(tf.Buffer, BufferInterface):
    """The script's buffer; a :class:`TransformListener` fills it. What waits needs ``rospy.init_node`` first."""

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
