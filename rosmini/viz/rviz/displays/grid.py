"""Grid: lines on the ground, or as a lattice in space."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.core.tf import TransformException
from rosmini.core.tf.rigid import transform_points
from rosmini.viz.rviz.context import FIXED_FRAME, Context
from rosmini.viz.rviz.display import Display, Level
from rosmini.viz.rviz.primitives import Lines, Primitive
from rosmini.viz.rviz.properties import Colour, Property, Vector

MAX_CELLS = 1000

_AXES = {"XY": (0, 1, 2), "XZ": (0, 2, 1), "YZ": (1, 2, 0)}
"""For each plane, the two axes in it and the axis across it."""


class Grid(Display, plugin="rviz/Grid"):
    """A grid in the plane of a frame."""

    properties = (
        Property("Reference Frame", FIXED_FRAME, "the frame that the grid lies in"),
        Property("Plane Cell Count", 10, "cells along the plane", minimum=1, maximum=MAX_CELLS),
        Property("Normal Cell Count", 0, "cells across the plane; 0: a flat grid", minimum=0, maximum=50),
        Property("Cell Size", 1.0, "the side of a cell", unit="m", minimum=0.0001, maximum=1e4),
        Property("Line Style", "Lines", "thin lines or wide ones", choices=("Lines", "Billboards")),
        Property("Line Style/Line Width", 0.03, "width of wide lines", unit="m", minimum=0.001),
        Property("Color", Colour(160, 160, 164), "colour of the lines"),
        Property("Alpha", 0.5, "opacity", minimum=0.0, maximum=1.0),
        Property("Plane", "XY", "the plane of the grid", choices=tuple(_AXES)),
        Property("Offset", Vector(0.0, 0.0, 0.0), "position of the middle in the frame", unit="m"),
    )

    def primitives(self, context: Context) -> Iterable[Primitive]:
        """Yield all lines as one primitive."""
        frame = self["Reference Frame"] or FIXED_FRAME
        try:
            place = context.place(frame)
        except TransformException as error:
            self.set_status(Level.ERROR, "Transform", context.problem(frame, error))
            return
        self.set_status(Level.OK, "Transform", "Transform OK")
        cells, layers, side = self["Plane Cell Count"], self["Normal Cell Count"], self["Cell Size"]
        along = (np.arange(cells + 1) - cells / 2) * side
        across = (np.arange(layers + 1) - layers / 2) * side
        if layers and cells > 50:
            across = across[:1]  # as many lines as a lattice of 50 cells, and no more
        end = np.full(cells + 1, along[-1])
        flat = np.concatenate([
            np.stack([np.column_stack([along, -end]), np.column_stack([along, end])], axis=1),
            np.stack([np.column_stack([-end, along]), np.column_stack([end, along])], axis=1),
        ]).reshape(-1, 2)  # fmt: skip
        points = np.vstack([np.column_stack([flat, np.full(len(flat), z)]) for z in across])
        if layers:
            uprights = np.array([(x, y, z) for x in along for y in along for z in (across[0], across[-1])])
            points = np.vstack([points, uprights])
        a, b, c = _AXES[self["Plane"]]
        placed = np.empty_like(points)
        placed[:, a], placed[:, b], placed[:, c] = points.T
        width = self["Line Style/Line Width"] if self["Line Style"] == "Billboards" else 0.0
        colour = self["Color"].rgba(self["Alpha"])
        yield Lines(transform_points(place, placed + self["Offset"]), colour, width, strip=False)
