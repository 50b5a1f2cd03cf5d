"""``tf2_ros.transform_listener``: fills a buffer."""

from __future__ import annotations

from rosmini import tf
from rosmini.rospy.session import require_node

__all__ = ["TransformListener"]


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
