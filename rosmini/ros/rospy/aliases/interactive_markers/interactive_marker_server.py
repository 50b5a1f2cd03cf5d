"""The module that scripts import as ``interactive_markers.interactive_marker_server``.

As in ROS, ``from interactive_markers.interactive_marker_server import *`` also imports the messages.
"""

from __future__ import annotations

from rosmini.ros import interactive_markers, rospy
from rosmini.ros.interactive_markers.server import (
    Header,
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
)
from rosmini.ros.rospy.session import require_node

__all__ = [
    "Header",
    "InteractiveMarker",
    "InteractiveMarkerFeedback",
    "InteractiveMarkerInit",
    "InteractiveMarkerPose",
    "InteractiveMarkerServer",
    "InteractiveMarkerUpdate",
    "rospy",
]


class InteractiveMarkerServer(interactive_markers.InteractiveMarkerServer):
    """Shows interactive markers of the script's node. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        super().__init__(require_node(f"an interactive marker server {topic_ns}"), topic_ns, server_id, q_size)
