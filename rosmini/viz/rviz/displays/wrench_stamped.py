"""WrenchStamped: a force as an arrow, and a torque as an arrow with a circle around it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from rosmini.core.geometry.products import matrix_product, norm
from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.marker_shapes import HEAD, SHAFT, towards
from rosmini.viz.rviz.primitives import Floats, Lines, Primitive, finite
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.shapes import arrow
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

MIN_LENGTH = 1e-9


class WrenchStamped(TopicDisplay, plugin="rviz/WrenchStamped"):
    """A `geometry_msgs/WrenchStamped` at the origin of its frame."""

    message = "geometry_msgs/WrenchStamped"
    history = "History Length"
    properties = (
        Property("Force Color", Colour(204, 51, 51), "colour of forces"),
        Property("Torque Color", Colour(204, 204, 51), "colour of torques"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Force Arrow Scale", 2.0, "length of an arrow per newton", unit="m/N", minimum=0.0),
        Property("Torque Arrow Scale", 2.0, "length of an arrow per newton metre", unit="m/(N m)", minimum=0.0),
        Property("Arrow Width", 0.5, "width of the arrows", unit="m", minimum=0.0),
        Property("Hide Small Values", True, "hide arrows that are shorter than wide"),
        Property("History Length", 1, "number of messages shown", minimum=1, maximum=100_000),
    )

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the two arrows."""
        del context
        wrench, place = received.message.wrench, matrix(received.place)
        for vector, name in ((wrench.force, "Force"), (wrench.torque, "Torque")):
            along: Floats = finite([(vector.x, vector.y, vector.z)], 3)[0] * self[f"{name} Arrow Scale"]
            length, width = norm(along), self["Arrow Width"]
            if length > (width if self["Hide Small Values"] else MIN_LENGTH):
                colour = self[f"{name} Color"].rgba(self["Alpha"])
                pose = matrix_product(place, towards(np.zeros(3), along))
                yield arrow(matrix_product(pose, np.diag([length, width, width, 1.0])), colour, SHAFT, 0.05, HEAD, 0.1)
                if name == "Torque":
                    yield from _turning(pose, length, width, colour)


def _turning(pose: Floats, length: float, width: float, colour: Any) -> Iterator[Primitive]:
    """Yield seven eighths of a circle around the middle of an arrow along x of `pose`, with its arrowhead."""
    angles = np.arange(4, 33) * (math.tau / 32)
    radius = length / 4
    circle = np.column_stack([np.full(len(angles), length / 2), radius * np.cos(angles), radius * np.sin(angles)])
    placed = matrix_product(circle, pose[:3, :3].T) + pose[:3, 3]
    yield Lines(placed, colour, 0.05 * width)
    head = towards(placed[-1], placed[-1] + pose[:3, 2])
    yield arrow(head, colour, 0.0, 0.05 * width, 0.1 * width, 0.1 * width)
