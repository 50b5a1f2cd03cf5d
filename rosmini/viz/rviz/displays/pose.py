"""Pose: a single pose, such as a navigation goal."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.pose_style import pose_properties, pose_shape
from rosmini.viz.rviz.primitives import Primitive
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class Pose(TopicDisplay, plugin="rviz/Pose"):
    """A `geometry_msgs/PoseStamped` as an arrow or as axes."""

    message = "geometry_msgs/PoseStamped"
    properties = pose_properties()

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the pose."""
        del context
        yield from pose_shape(received.pose(received.message.pose), self)
