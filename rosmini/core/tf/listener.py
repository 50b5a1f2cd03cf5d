"""The listener: receives transforms from `/tf` and `/tf_static` into a buffer (http://wiki.ros.org/tf2_ros)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.msgs import message_class

from .buffer import Buffer

if TYPE_CHECKING:
    from rosmini.core.graph import Node

UNKNOWN = "unknown_publisher"


class TransformListener:
    """Fills `buffer` (by default a new one) with the transforms that a node receives on `/tf` and `/tf_static`.

    If the node's time jumps back (a simulation or a bag restarts), the buffer is cleared, as in tf2.
    """

    def __init__(self, node: Node, buffer: Buffer | None = None, queue_size: int | None = None) -> None:
        self.node = node
        self.buffer = Buffer(node) if buffer is None else buffer
        self.last_update_ns = node.clock.now_ns()
        kind = message_class("tf2_msgs/TFMessage")
        self._subscribers = [
            node.subscriber("/tf", kind, self.callback, queue_size=queue_size, numpy=False),
            node.subscriber("/tf_static", kind, self.static_callback, queue_size=queue_size, numpy=False),
        ]

    def callback(self, data: Any) -> None:
        """Add the transforms of a message on `/tf` to the buffer."""
        self.check_for_reset()
        authority = data._connection_header.get("callerid", UNKNOWN)
        self.buffer.set_transforms(data.transforms, authority)

    def static_callback(self, data: Any) -> None:
        """Add the transforms of a message on `/tf_static` to the buffer."""
        self.check_for_reset()
        authority = data._connection_header.get("callerid", UNKNOWN)
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, authority)

    def check_for_reset(self) -> None:
        """Clear the buffer, with a warning, if time has jumped back since the last message."""
        now = self.node.clock.now_ns()
        if now < self.last_update_ns:
            self.node.logwarn("Detected jump back in time. Clearing TF buffer.")
            self.buffer.clear()
        self.last_update_ns = now

    def unregister(self) -> None:
        """Stop receiving."""
        for subscriber in self._subscribers:
            subscriber.unregister()
