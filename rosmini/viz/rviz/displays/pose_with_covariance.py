"""PoseWithCovariance: a pose with its uncertainty, such as that of amcl."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.pose_style import COVARIANCE_PROPERTIES, covariance_shape, pose_properties, pose_shape
from rosmini.viz.rviz.primitives import Primitive
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class PoseWithCovariance(TopicDisplay, plugin="rviz/PoseWithCovariance"):
    """A `geometry_msgs/PoseWithCovarianceStamped`."""

    message = "geometry_msgs/PoseWithCovarianceStamped"
    properties = (*pose_properties(), *COVARIANCE_PROPERTIES)

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the pose, its ellipsoid, and the sector of its yaw."""
        del context
        found = received.message.pose
        pose = received.pose(found.pose)
        yield from pose_shape(pose, self)
        yield from covariance_shape(pose, found.covariance, self, received)
