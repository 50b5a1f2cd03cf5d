"""Range: the reading of a distance sensor (sonar, infrared), as a cone."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.primitives import INVALID, DisplayError, Primitive
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.shapes import cone
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class Range(TopicDisplay, plugin="rviz/Range"):
    """A `sensor_msgs/Range`: a cone from the sensor along its x axis, as long as the range; no cone without an echo."""

    message = "sensor_msgs/Range"
    history = "Buffer Length"
    properties = (
        Property("Color", Colour(255, 255, 255), "colour of the cones"),
        Property("Alpha", 0.5, "opacity", minimum=0.0, maximum=1.0),
        Property("Buffer Length", 1, "number of messages shown", minimum=1, maximum=1000),
    )

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the cone. A sensor that only detects (minimum range = maximum range) reports -inf for a near object."""
        del context
        found = received.message
        low, high, reach = float(found.min_range), float(found.max_range), float(found.range)
        if not all(map(math.isfinite, (low, high, found.field_of_view))):
            raise DisplayError(INVALID)
        if low == high and reach < 0:
            reach = low
        if not low <= reach <= high:
            self.set_status(Level.OK, "Range", f"{reach:g} m is out of range: no cone")
            return
        self.set_status(Level.OK, "Range", f"{reach:.2f} m of {low:g} to {high:g} m")
        half = min(max(float(found.field_of_view) / 2, 0.0), math.radians(85))
        shape = cone(matrix(received.place), self["Color"].rgba(self["Alpha"]), reach, reach * math.tan(half))
        if np.isfinite(shape.placed).all():
            yield shape
