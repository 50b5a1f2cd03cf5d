"""Axes: the axes of one frame."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import matrix
from rosmini.viz.rviz.context import FIXED_FRAME, Context
from rosmini.viz.rviz.display import Display, Level
from rosmini.viz.rviz.primitives import Primitive
from rosmini.viz.rviz.properties import Property
from rosmini.viz.rviz.shapes import axes


class Axes(Display, plugin="rviz/Axes"):
    """Three rods: x red, y green, z blue."""

    properties = (
        Property("Reference Frame", FIXED_FRAME, "the frame that is shown"),
        Property("Length", 1.0, "size of each axis", unit="m", minimum=0.0001, maximum=1e4),
        Property("Radius", 0.1, "size of each axis", unit="m", minimum=0.0001, maximum=1e4),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
        Property("Show Trail", False, "not supported"),
    )

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Yield the axes, if the frame is known."""
        frame = self["Reference Frame"] or FIXED_FRAME
        try:
            place = context.place(frame)
        except TransformException as error:
            self.set_status(Level.ERROR, "Transform", context.problem(frame, error))
            return
        self.set_status(Level.OK, "Transform", "Transform OK")
        yield from axes(matrix(place), self["Length"], self["Radius"], self["Alpha"])
