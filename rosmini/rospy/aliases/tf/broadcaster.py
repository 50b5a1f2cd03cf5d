"""``tf.broadcaster``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini import tf
from rosmini.rospy.session import require_node
from rosmini.tf.messages import to_stamped
from rosmini.time import Time

__all__ = ["TransformBroadcaster"]


class TransformBroadcaster:
    """Sends transforms on ``/tf``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, queue_size: int = 100) -> None:
        self._broadcaster = tf.TransformBroadcaster(
            require_node("tf.TransformBroadcaster"), queue_size=queue_size
        )

    def sendTransform(
        self, translation: Sequence[float], rotation: Sequence[float], time: Time, child: str, parent: str
    ) -> None:
        """Say where ``child`` is in ``parent``: translation [m] and quaternion (x, y, z, w), as they are."""
        x, y, z = (float(value) for value in translation)
        qx, qy, qz, qw = (float(value) for value in rotation)
        self.sendTransformMessage(to_stamped(parent, child, (x, y, z, qx, qy, qz, qw), time.to_nsec()))

    def sendTransformMessage(self, transform: Any) -> None:
        """Send a ``geometry_msgs/TransformStamped``."""
        self._broadcaster.sendTransform(transform)
