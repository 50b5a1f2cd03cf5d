"""Map: an occupancy grid or a costmap, in RViz's colours."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.tf.rigid import compose, matrix
from rosmini.viz.map_colours import SCHEMES, painted, thinned
from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.display import Level
from rosmini.viz.rviz.primitives import DisplayError, Pixels, Primitive, Texture
from rosmini.viz.rviz.properties import Property
from rosmini.viz.rviz.topic_display import Received, TopicDisplay

MAX_CELLS = 100_000_000


class Map(TopicDisplay, plugin="rviz/Map"):
    """A `nav_msgs/OccupancyGrid`, and the `map_msgs/OccupancyGridUpdate`s that change parts of it."""

    message = "nav_msgs/OccupancyGrid"
    properties = (
        Property("Alpha", 0.7, "opacity", minimum=0.0, maximum=1.0),
        Property("Color Scheme", "map", "how cells are coloured", choices=SCHEMES),
        Property("Draw Behind", False, "behind everything else"),
        Property("Use Timestamp", False, "where the map's frame was at its stamp, not where it is now"),
    )

    def start(self, context: Context) -> None:
        """Subscribe to the map and to its updates."""
        super().start(context)
        if self._subscriptions:
            self.set_status(Level.WARN, "Map", "No map received")
            try:
                topic, kind = f"{self.topic}_updates", "map_msgs/OccupancyGridUpdate"
                self.subscribe(context, topic, kind, self._change)
                self.set_status(Level.OK, "Update Topic", "OK")
            except RosminiError as error:
                self.fail("Update Topic", error)

    def accept(self, received: Received, context: Context) -> bool:
        """Accept a map; its cells are copied, because updates change them."""
        del context
        info, count = received.message.info, len(received.message.data)
        width, height = int(info.width), int(info.height)
        if width * height == 0:
            raise DisplayError(f"Map is zero-sized ({width}x{height})")
        if width * height > MAX_CELLS:
            raise DisplayError(f"a map of {width}x{height} cells is too large: at most {MAX_CELLS} cells")
        if count != width * height:
            raise DisplayError(
                f"Data size doesn't match width*height: width = {width}, height = {height}, data size = {count}"
            )
        if not 0 < info.resolution < 1e6:
            raise DisplayError(f"a resolution of {info.resolution:g} m is invalid")
        self._cells: Pixels = np.array(received.message.data, dtype=np.int8).view(np.uint8).reshape(height, width)
        return True

    def _change(self, update: Any) -> None:
        """Apply an update: a rectangle of new cells."""
        if not self.stored:
            return
        rows, columns = int(update.height), int(update.width)
        x, y = int(update.x), int(update.y)
        height, width = self._cells.shape
        if not (0 <= x <= x + columns <= width and 0 <= y <= y + rows <= height) or len(update.data) != rows * columns:
            self.set_status(Level.ERROR, "Update", "Update area outside of original map area.")
            return
        fresh = np.array(update.data, dtype=np.int8).view(np.uint8).reshape(rows, columns)
        self._cells[y : y + rows, x : x + columns] = fresh
        self.stored[-1].drawn = None
        self.set_status(Level.OK, "Update", "Update OK")

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the cells as a texture, thinned to a visible resolution."""
        del context
        info = received.message.info
        origin = received.local(info.origin)
        height, width = self._cells.shape
        cells, factor = thinned(self._cells, self["Color Scheme"])
        pixels = painted(cells, self["Color Scheme"])
        pixels[..., 3] = np.round(pixels[..., 3] * float(self["Alpha"]))
        side = factor * float(info.resolution)
        size = (cells.shape[1] * side, cells.shape[0] * side)
        place = matrix(compose(received.place, origin))
        self.set_status(Level.OK, "Map", f"Map received: {width} x {height} cells of {info.resolution:g} m")
        yield Texture(pixels, size, place, behind=self["Draw Behind"])

    def moment(self, received: Received) -> int:
        """Return the stamp if it is to be used, otherwise 0 for now."""
        return received.stamp_ns if self["Use Timestamp"] else 0
