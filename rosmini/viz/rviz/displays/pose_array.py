"""PoseArray: many poses, such as the particles of amcl."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.core.geometry.products import matrix_product
from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.pose_style import length_property
from rosmini.viz.rviz.primitives import Floats, Lines, Primitive
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.shapes import arrow, axes, flat_arrow
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

SHAPES = ("Arrow (Flat)", "Arrow (3D)", "Axes", "Arrow")
MAX_FLAT, MAX_SOLID = 20_000, 500
"""Maximum numbers of poses drawn; of more, an evenly spaced selection is drawn."""


class PoseArray(TopicDisplay, plugin="rviz/PoseArray"):
    """A `geometry_msgs/PoseArray` as flat arrows, which form one primitive, or as 3D arrows or axes."""

    message = "geometry_msgs/PoseArray"
    properties = (
        Property("Shape", "Arrow (Flat)", "how a pose is drawn", choices=SHAPES),
        Property("Color", Colour(255, 25, 0), "colour of the arrows"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        length_property("Arrow Length", 0.3), length_property("Axes Length", 0.3), length_property("Axes Radius", 0.01),
        length_property("Head Length", 0.07), length_property("Head Radius", 0.03),
        length_property("Shaft Length", 0.23), length_property("Shaft Radius", 0.01),
    )  # fmt: skip

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the poses."""
        del context
        poses = received.message.poses
        is_flat = self["Shape"] == "Arrow (Flat)"
        step = -(-len(poses) // (MAX_FLAT if is_flat else MAX_SOLID)) or 1
        shown = [received.local(pose) for pose in poses[::step]]
        text = f"Showing [{len(shown)}] of [{len(poses)}] poses"
        self.set_status(Level.OK if step == 1 else Level.WARN, "Poses", text)
        colour = self["Color"].rgba(self["Alpha"])
        base: Floats = matrix(received.place)
        placed = [matrix_product(base, matrix(pose)) for pose in shown]
        if is_flat:
            if placed:
                arrows = [flat_arrow(pose, colour, self["Arrow Length"]).points for pose in placed]
                yield Lines(np.vstack(arrows), colour, strip=False)
            return
        for pose in placed:
            if self["Shape"] == "Axes":
                yield from axes(pose, self["Axes Length"], self["Axes Radius"])
            else:
                sizes = (self[name] for name in ("Shaft Length", "Shaft Radius", "Head Length", "Head Radius"))
                yield arrow(pose, colour, *sizes)
