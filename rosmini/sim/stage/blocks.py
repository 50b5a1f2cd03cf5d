"""Bodies of Stage's models: blocks, which are polygons with a bottom and a top, or the dark pixels of an image.

A body is stretched to the model's `size`: its bounding box gets that size, and its centre becomes the model's
origin. So a floor plan's image needs black up to its edges (or a `boundary`) to keep its scale: white margins are
ignored, which surprises users of map_server. A pixel is dark if its first channel is at most 127 (facts:
libstage's blockgroup.cc, block.cc and stage.cc).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rosmini.core import images
from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.polygons import area, crossing_sides
from rosmini.sim.geometry.contours import outlines
from rosmini.sim.models import hull

from .errors import Place, StageError

Floats = NDArray[np.float64]
Size = tuple[float, float, float]

MAX_PIXELS = 32_000_000
"""Maximum number of pixels of all bitmaps of a world."""

MAX_OUTLINES = 5_000
"""Maximum number of outlines of all bitmaps of a world but the first, each as often as it is used."""
TOO_MANY = f"the bitmaps after a world's first have more than {MAX_OUTLINES} outlines"

THRESHOLD = 127
EDGE = 0.01
"""Thickness of a boundary [m]."""


@dataclass(frozen=True)
class Block:
    """A closed outline (n, 2), counter-clockwise, or clockwise for a hole, from one height to another."""

    outline: Floats
    bottom: float = 0.0
    top: float = 1.0


@dataclass(frozen=True)
class Body:
    """The geometry of a model, in its own frame [m]."""

    blocks: tuple[Block, ...]
    traced: bool = False
    """True if it is from an image: its outlines do not touch, but can be holes in others."""
    boundary: tuple[Block, ...] = ()
    """A frame around the whole body."""


def square() -> Block:
    """Return the default block of a model."""
    return Block(np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]))


def block(points: Floats, bottom: float, top: float) -> tuple[Block | None, str]:
    """Return a block of these vertices (n, 2), in either sense, and a remark; None if it encloses nothing.

    Stage draws the sides of any list of points; here a block whose sides cross becomes its convex hull.
    """
    if len(points) < 3:
        return None, f"a block needs 3 points or more, not {len(points)}: it is left out"
    if top <= bottom:
        return (None, f"the z of a block goes from {bottom:g} up to {top:g}, so nothing meets it: it is left out")
    crossing = crossing_sides(points)
    odd = ""
    if crossing is not None:
        first, second = crossing
        odd = f"the sides of a block meet that begin at point[{first}] and point[{second}]: it is read as its hull"
        points = np.array(hull([(x, y) for x, y in points.tolist()])).reshape(-1, 2)
    size = area(points) if len(points) > 2 else 0.0
    if size == 0:
        return None, "the points of a block enclose nothing: it is left out"
    return Block(points if size > 0 else points[::-1], bottom, top), odd


@dataclass(frozen=True)
class Picture:
    """The dark parts of a bitmap, in pixels, y up."""

    blocks: tuple[Block, ...]
    box: tuple[float, float, float, float]
    """Around all of them: x0, y0, x1, y1."""
    pixels: int
    odd: str = ""
    """Unusual features, for a note."""


def picture(path: Path, place: Place, room: int) -> Picture:
    """Read a bitmap of at most `room` pixels. Raises `StageError`."""
    try:
        with images.opened(path) as found:
            pixels = found.width * found.height
            if pixels > room:
                raise images.ImageError(f"with it the bitmaps of this world have more than {MAX_PIXELS} pixels")
            dark = np.empty((found.height, found.width), dtype=bool)
            for top, strip in images.strips(found):
                below = np.asarray(strip.convert("RGB"))[:, :, 0] <= THRESHOLD
                dark[found.height - top - len(below) : found.height - top] = below[::-1]
    except (images.ImageError, OSError) as error:
        what = f"cannot be read: {error}"
        raise StageError(place, f"the bitmap {path} {what}", f"the bitmap {what}") from error
    if not dark.any():
        odd = f"nothing in the bitmap is dark (first channel up to {THRESHOLD}), so it has no body"
        return Picture((), (0.0, 0.0, 1.0, 1.0), pixels, odd)
    columns, rows = np.flatnonzero(dark.any(axis=0)), np.flatnonzero(dark.any(axis=1))
    box = (float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1))
    height, width = dark.shape
    odd = ""
    if (box[2] - box[0], box[3] - box[1]) != (width, height):
        odd = (
            f"of the bitmap's {width} x {height} pixels the {box[2] - box[0]:.0f} x {box[3] - box[1]:.0f} that are not "
            "white margin are stretched to the model's size"
        )
    try:
        loops = outlines(dark)
    except GeometryError as error:
        raise StageError(place, f"the bitmap {path} is too detailed: {error}", str(error)) from error
    return Picture(tuple(Block(loop) for loop in loops), box, pixels, odd)


def stretched(
    blocks: tuple[Block, ...], size: Size, box: tuple[float, float, float, float] | None = None
) -> tuple[Block, ...]:
    """Scale blocks so that their bounding box, or `box` (x0, y0, x1, y1), has a size [m] and is centred.

    Heights are scaled from 0 and not shifted.
    """
    if not blocks:
        return ()
    if box is None:
        points = np.vstack([each.outline for each in blocks])
        box = (*points.min(axis=0).tolist(), *points.max(axis=0).tolist())
    x0, y0, x1, y1 = box
    low, high = min(each.bottom for each in blocks), max(each.top for each in blocks)
    middle = np.array([(x0 + x1) / 2, (y0 + y1) / 2])
    scale = np.array([size[0] / (x1 - x0), size[1] / (y1 - y0)])
    up = size[2] / (high - low)
    return tuple(Block((each.outline - middle) * scale, each.bottom * up, each.top * up) for each in blocks)


def frame(size: Size) -> tuple[Block, ...]:
    """Return the boundary of a body of this size: four thin walls within it."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    sides = ((-x, -y, x, -y + EDGE), (-x, y - EDGE, x, y), (-x, -y, -x + EDGE, y), (x - EDGE, -y, x, y))
    return tuple(Block(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), 0.0, z) for x0, y0, x1, y1 in sides)
