"""An image and the map that it makes, side by side, with dials for thresholds, mode and negate to turn in the page."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.map_server.grid_map import GridMap
from rosmini.navigation.map_server.map_io import MODES, Fields, MapFile, occupancy_of
from rosmini.viz.figures import WIDTH
from rosmini.viz.map_colours import colours_of, painted
from rosmini.viz.map_pictures import cells_element, gif_address, shares
from rosmini.viz.moving_view import MovingView
from rosmini.viz.rviz.gifs import gif
from rosmini.viz.style import LABEL_SIZE
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import ViewError

LARGEST = 256
"""An image has so many pixels a side, at most: they are in the page."""
GAP, HEAD = 20.0, 22.0
"""Between the two images, and above them [px]."""
CONTROLS = 130
"""The height of the dials, about [px]."""


def map_dials(file: MapFile, *, title: str | None = None) -> MapDials:
    """Show the image of a map and what map_server makes of it, as a function of the numbers beside it.

    Args:
        file: the description of a map: `map_file("house.yaml")`.
        title: a caption, and the first words of the text form.

    Raises:
        MapError: the image cannot be read.
        ViewError: the image has colours, or is too large.

    """
    if not isinstance(file, MapFile):
        raise ViewError(
            f"dials are for the description of a map, map_file(...), not for a {type(file).__name__}"
        )
    pixels = file.pixels()
    height, width, channels = pixels.shape
    if channels != 1:
        raise ViewError(f"{file.image.name} has {channels} channels: only images in grey have dials")
    if max(height, width) > LARGEST:
        raise ViewError(
            f"{file.image.name} has {width} x {height} pixels: with dials, {LARGEST} a side are shown at most"
        )
    return MapDials(file.fields, pixels[..., 0], file.image.name, title)


class MapDials(MovingView):
    """What `map_dials` gives; its image shows the map by the numbers of the file."""

    scripts = ("rosmini-map-dials.js",)
    call = "rosminiMapDials.mount"
    usual_name = "map image"

    def __init__(self, fields: Fields, greys: NDArray[np.uint8], name: str, title: str | None) -> None:
        self._fields, self._greys, self._name, self.title = fields, greys, name, title
        self._map = GridMap(occupancy_of(greys[..., None], fields), fields.resolution, fields.origin)

    @property
    def text(self) -> str:
        """The numbers of the file, and what they make of the image."""
        fields, (height, width) = self._fields, self._greys.shape
        return (
            f"{self.name}: {self._name}, {width} x {height} pixels\n"
            f"mode {fields.mode}, negate {int(fields.negate)}, free_thresh {fields.free_thresh:g}, "
            f"occupied_thresh {fields.occupied_thresh:g}\n{', '.join(shares(self._map))}"
        )

    @property
    def alt(self) -> str:
        """The same in two sentences."""
        _, numbers, parts = self.text.split("\n")
        return f"On the left an image in grey, {self._name}; on the right the map it makes. With {numbers}: {parts}."

    @property
    def svg(self) -> str:
        """The still picture."""
        height, width = self._greys.shape
        wide = (WIDTH - GAP) / 2
        high = wide * height / width
        images = (self._greys, "raw", "image"), (self._map.occupancy.view(np.uint8), "map", "map")
        parts = []
        for number, (cells, scheme, label) in enumerate(images):
            x = number * (wide + GAP)
            address = gif_address(gif(painted(cells[::-1], scheme))[0])
            parts.append(
                element("text", escape(label), x=x, y=HEAD - 7, font_size=LABEL_SIZE, class_="rm-what")
            )
            parts.append(cells_element(address, x=x, y=HEAD, width=wide, height=high))
        css = ".rosmini-svg .rm-what{fill:var(--rosmini-muted)}"
        return document(
            "".join(parts), width=WIDTH, height=HEAD + high + 1, title=self.name, alt=self.alt,
            css=css, colours=["muted"],
        )  # fmt: skip

    @property
    def height(self) -> int:
        """With the controls, about [CSS px]."""
        height, width = self._greys.shape
        return int(round((WIDTH - GAP) / 2 * height / width) + CONTROLS)

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script gets: the greys, their upper row first, and the numbers of the file."""
        fields, (height, width) = self._fields, self._greys.shape
        return {
            "name": self._name,
            "size": [width, height],
            "greys": self._greys[::-1].tobytes(),
            "colours": colours_of("map")[:, :3].tobytes(),
            "modes": list(MODES),
            "mode": fields.mode,
            "negate": fields.negate,
            "free": fields.free_thresh,
            "occupied": fields.occupied_thresh,
        }
