"""The base of displays of points: their properties, and the number of points that they show."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from .context import Context
from .display import Level
from .points_style import POINT_PROPERTIES
from .primitives import Points, Primitive
from .properties import Property
from .topic_display import TopicDisplay


class PointsDisplay(TopicDisplay):
    """The base of displays that draw a message as points."""

    properties: ClassVar[tuple[Property, ...]] = POINT_PROPERTIES

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Return the points of all stored messages."""
        found = list(super().primitives(context))
        count = sum(len(each.points) for each in found if isinstance(each, Points))
        if self.stored:
            text = f"Showing [{count}] points from [{len(self.stored)}] messages"
            self.set_status(Level.OK if count else Level.WARN, "Points", text)
        return found
