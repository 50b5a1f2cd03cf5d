"""Colours of grids, one table for all pictures: RViz's three schemes, and one for every kind of colour vision.

A cell of `nav_msgs/OccupancyGrid` is a byte: maps and costmaps use 0 to 100, -1 (255) is unknown, and the others
are illegal (http://wiki.ros.org/rviz/DisplayTypes/Map).

| scheme | 0 | 1 to 98 | 99 | 100 | unknown |
|---|---|---|---|---|---|
| `map` | white | lighter to darker grey | nearly black | black | grey green |
| `costmap` | transparent | blue to red | cyan: not for the robot's centre | magenta: an obstacle | grey green |
| `safe` | transparent | pale to full blue | orange | vermilion | grey, faint |
| `raw` | the byte itself as grey | | | | white |
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.errors import nearest
from rosmini.viz.view import ViewError

Colours = NDArray[np.uint8]

SCHEMES = ("map", "costmap", "raw", "safe")
"""The first three are RViz's, by their names; "safe" shows a costmap in colours for every kind of colour vision."""
UNKNOWN = 255
"""The byte of -1, an unknown cell."""
ALPHA = 0.7
"""Default opacity of a map in RViz."""


@cache
def colours_of(scheme: str = "map") -> Colours:
    """Return the colours (256, 4) of a scheme: red, green, blue and alpha (0 to 255) per cell value, read-only.

    Raises:
        ViewError: the scheme does not exist.

    """
    if scheme not in SCHEMES:
        there = ", ".join(SCHEMES)
        hint = nearest(scheme, SCHEMES) or ""
        raise ViewError(f"grids have no colour scheme {scheme!r}, only {there}. {hint}".rstrip())
    table = np.zeros((256, 4), dtype=np.uint8)
    grey = np.arange(256)
    if scheme == "raw":
        table[:] = np.column_stack([grey, grey, grey, np.full(256, 255)])
    else:
        table[101:128] = (0, 255, 0, 255)
        table[128:255] = [(255, 255 * i // 126, 0, 255) for i in range(127)]
        table[UNKNOWN] = (0x70, 0x89, 0x86, 255)
        if scheme == "map":
            table[:101] = [(255 - 255 * i // 100,) * 3 + (255,) for i in range(101)]
        elif scheme == "costmap":
            table[1:99] = [(255 * i // 100, 0, 255 - 255 * i // 100, 255) for i in range(1, 99)]
            table[99:101] = (0, 255, 255, 255), (255, 0, 255, 255)
        else:
            part = np.linspace(0.0, 1.0, 98)[:, None]
            table[1:99, :3] = np.rint((1 - part) * (214, 234, 248) + part * (0, 114, 178))
            table[1:99, 3] = 255
            table[99:101] = (230, 159, 0, 255), (213, 94, 0, 255)
            table[UNKNOWN] = (128, 128, 128, 64)
    table.setflags(write=False)
    return table


def painted(cells: ArrayLike, scheme: str = "map") -> Colours:
    """Return the colours (..., 4) of cells (...), which are bytes, signed (as in messages) or unsigned.

    Raises:
        ViewError: the scheme does not exist.

    """
    values = np.asarray(cells).astype(np.int16) & 0xFF
    coloured: Colours = colours_of(scheme)[values]
    return coloured


def scheme_of(topic: str) -> str:
    """Return the default scheme of a grid on a topic: `costmap` if its name contains that word, otherwise `map`."""
    return "costmap" if "costmap" in topic else "map"


MAX_SIDE = 640
"""Maximum number of cells per side of a drawing: a page shows no more."""


def thinned(cells: Colours, scheme: str) -> tuple[Colours, int]:
    """Return a map (h, w) with at most `MAX_SIDE` cells a side, and the number of cells per side that each combines.

    Of several cells, the most occupied one is used, so that walls are preserved; unknown is used last.
    """
    factor = math.ceil(max(cells.shape) / MAX_SIDE)
    if factor <= 1:
        return cells, 1
    # -1 must not override known cells; as a signed byte it is the minimum
    order = cells if scheme == "raw" else cells.view(np.int8)
    least = order.min() if scheme == "raw" else np.int8(-128)
    height, width = (-(-side // factor) * factor for side in cells.shape)
    padded = np.full((height, width), least, dtype=order.dtype)
    padded[: cells.shape[0], : cells.shape[1]] = order
    best = padded.reshape(height // factor, factor, width // factor, factor).max(axis=(1, 3))
    return best.view(np.uint8), factor
