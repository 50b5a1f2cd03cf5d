"""``tf2_ros.transform_broadcaster``."""

from __future__ import annotations

from rosmini import tf
from rosmini.rospy.session import require_node

__all__ = ["TransformBroadcaster"]


class TransformBroadcaster(tf.TransformBroadcaster):
    """Sends transforms that change. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self) -> None:
        super().__init__(require_node("tf2_ros.TransformBroadcaster"))
