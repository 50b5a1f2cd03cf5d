"""GridCells: cells of a grid that share a property, such as obstacles."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.primitives import DisplayError, Points, Primitive
from rosmini.viz.rviz.properties import Colour, Property
from rosmini.viz.rviz.topic_display import Received, TopicDisplay


class GridCells(TopicDisplay, plugin="rviz/GridCells"):
    """A `nav_msgs/GridCells` as squares."""

    message = "nav_msgs/GridCells"
    properties = (
        Property("Color", Colour(25, 255, 0), "colour of the cells"),
        Property("Alpha", 1.0, "opacity", minimum=0.0, maximum=1.0),
    )

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the cells whose positions are finite."""
        del context
        found = received.message
        for name, side in (("width", found.cell_width), ("height", found.cell_height)):
            if not 0 < side < 1e6:
                raise DisplayError(f"Cell {name} is {side:g}, cells will be invisible")
        points = received.points(found.cells)
        known = np.isfinite(points).all(axis=1)
        if not known.all():
            received.note(f"{int((~known).sum())} cells have invalid positions (nans or infs)")
        self.set_status(Level.OK, "Cells", f"{int(known.sum())} cells")
        side = float(found.cell_width + found.cell_height) / 2
        yield Points(points[known], self["Color"].rgba(self["Alpha"]), side, "Tiles")
