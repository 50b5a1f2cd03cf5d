"""Odometry: arrows along the path that a robot estimates from odometry."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rosmini.core.tf.rigid import Rigid
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.pose_style import COVARIANCE_PROPERTIES, covariance_shape, pose_properties, pose_shape
from rosmini.viz.rviz.primitives import INVALID, DisplayError, Primitive
from rosmini.viz.rviz.properties import Property
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class Odometry(TopicDisplay, plugin="rviz/Odometry"):
    """Arrows of a `nav_msgs/Odometry`, one per step of some length; the latest ones are kept."""

    message = "nav_msgs/Odometry"
    history = "Keep"
    properties = (
        Property("Position Tolerance", 0.1, "distance after which a new arrow is drawn", unit="m", minimum=0.0),
        Property("Angle Tolerance", 0.1, "rotation after which a new arrow is drawn", unit="rad", minimum=0.0),
        Property("Keep", 100, "number of arrows shown; 0 for all", minimum=0, maximum=10_000),
        *pose_properties("Shape/"),
        *COVARIANCE_PROPERTIES,
    )

    def accept(self, received: Received, context: Context) -> bool:
        """Return True if the pose is far enough from the last one."""
        del context
        found = received.message
        if not np.isfinite(np.asarray(found.pose.covariance, dtype=float)).all():
            raise DisplayError(INVALID)
        now = received.local(found.pose.pose)
        if self.stored:
            last = self.stored[-1].local(self.stored[-1].message.pose.pose)
            near = math.dist(now[:3], last[:3]) < self["Position Tolerance"]
            if near and _turned(now, last) < self["Angle Tolerance"]:
                return False
        return True

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield an arrow and its uncertainty."""
        del context
        found = received.message.pose
        pose = received.pose(found.pose)
        yield from pose_shape(pose, self, "Shape/")
        yield from covariance_shape(pose, found.covariance, self, received)


def _turned(a: Rigid, b: Rigid) -> float:
    """Return the angle between two orientations [rad]."""
    cosine = abs(sum(x * y for x, y in zip(a[3:], b[3:], strict=True)))
    return 2.0 * math.acos(min(cosine, 1.0))
