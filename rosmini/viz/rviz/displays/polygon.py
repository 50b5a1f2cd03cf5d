"""Polygon: an outline, such as a robot's footprint."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.primitives import Primitive
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.shapes import outline
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class Polygon(TopicDisplay, plugin="rviz/Polygon"):
    """A `geometry_msgs/PolygonStamped` as a closed line."""

    message = "geometry_msgs/PolygonStamped"
    properties = (
        Property("Color", Colour(25, 255, 0), "colour of the line"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
    )

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the line."""
        del context
        yield outline(received.points(received.message.polygon.points), self["Color"].rgba(self["Alpha"]))
