"""PointStamped: a point, such as one that a user clicked."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.primitives import INVALID, DisplayError, Primitive
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.shapes import ball
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class PointStamped(TopicDisplay, plugin="rviz/PointStamped"):
    """A `geometry_msgs/PointStamped` as a ball."""

    message = "geometry_msgs/PointStamped"
    history = "History Length"
    properties = (
        Property("Color", Colour(204, 41, 204), "colour of the balls"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Radius", 0.2, "radius of the balls", unit="m", minimum=0.0, maximum=1e4),
        Property("History Length", 1, "number of points shown", minimum=1, maximum=10_000),
    )

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield a ball."""
        del context
        pose = np.eye(4)
        pose[:3, 3] = received.points([received.message.point])[0]
        if not np.isfinite(pose).all():
            raise DisplayError(INVALID)
        yield ball(pose, self["Color"].rgba(self["Alpha"]), (2.0 * self["Radius"],) * 3)
