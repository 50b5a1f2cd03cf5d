"""The size of a published map: initially from `xmin` to `ymax`, and more when the robot sees farther.

As in the original the size is a whole number of blocks of 32 cells (20 m at 0.05 m are 384 cells, not 400), and a map
that has to grow gets 10 m more than it needs. Unlike there, cell corners are multiples of the resolution, as in
OccupancyGrid (the original's published map is shifted by half a cell).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError

from .maps import MAX_PATCHES, SIDE
from .slam import GridSlam

GROWTH_MARGIN = 10.0
"""Additional margin of a map that has to grow [m]."""


LARGEST_SIDE = 10_000
"""An initial map with more cells than a square of this side [cells] is limited."""


class Extent(NamedTuple):
    """A rectangle of cells from (column, row) on the lattice of `SharedMaps`."""

    column: int
    row: int
    width: int
    height: int


def first_extent(
    xmin: float, ymin: float, xmax: float, ymax: float, delta: float, warn: Callable[[str], object]
) -> Extent:
    """Return the initial extent of a map, given in metres.

    As in the original, bounds in the wrong order give a small map at xmin or ymin, which grows. Calls `warn` for such
    bounds, and for a map of more than `LARGEST_SIDE` squared cells, of which the part around the origin remains.
    """
    if not (xmin < xmax and ymin < ymax):
        warn(
            f"a map from xmin {xmin} to xmax {xmax} m and from ymin {ymin} to ymax {ymax} m has no cells: "
            "it starts small and grows; xmin and ymin should be smaller than xmax and ymax"
        )
    columns, rows = (max(math.ceil(length / delta - 1e-6) // SIDE, 1) for length in (xmax - xmin, ymax - ymin))
    left, low = math.floor(xmin / delta + 1e-6), math.floor(ymin / delta + 1e-6)
    most = LARGEST_SIDE // SIDE
    if columns * rows > most * most:
        warn(
            f"a map from xmin {xmin} to xmax {xmax} m and from ymin {ymin} to ymax {ymax} m has more than "
            f"{LARGEST_SIDE} x {LARGEST_SIDE} cells of {delta} m: it starts with fewer, and grows"
        )
        left, columns = _part(left, columns, most)
        low, rows = _part(low, rows, most)
    return Extent(left, low, columns * SIDE, rows * SIDE)


def _part(low: int, blocks: int, most: int) -> tuple[int, int]:
    """Return the first cell and the number of at most `most` of the blocks, as near to cell 0 as possible."""
    high = low + max(blocks - most, 0) * SIDE
    return min(max(low, -most * SIDE // 2), high), min(blocks, most)


def grown(extent: Extent, seen: Extent, delta: float) -> Extent:
    """Return the extent enlarged to contain the cells `seen`, with `GROWTH_MARGIN` [m] on each side that grows."""
    if not (seen.width and seen.height):
        return extent
    column, width = _grown(extent.column, extent.width, seen.column, seen.width, delta)
    row, height = _grown(extent.row, extent.height, seen.row, seen.height, delta)
    return Extent(column, row, width, height)


def _grown(low: int, size: int, from_: int, count: int, delta: float) -> tuple[int, int]:
    more = GROWTH_MARGIN / delta
    before = math.ceil((low - from_ + more) / SIDE) if from_ < low else 0
    after = math.ceil((from_ + count - low - size + more) / SIDE) if from_ + count > low + size else 0
    return low - before * SIDE, size + (before + after) * SIDE


def published(slam: GridSlam, extent: Extent, threshold: float) -> tuple[NDArray[np.int8], Extent]:
    """Return the best particle's map (h, w) as nav_msgs/OccupancyGrid values, and its extent, which may have grown.

    A cell is occupied if more than the fraction `threshold` of its visits were beam ends. Raises `RosminiError` if the
    map would be too large.
    """
    shares, seen = known(slam, slam.best)
    extent = grown(extent, seen, slam.settings.delta)
    if extent.width * extent.height > MAX_PATCHES * SIDE * SIDE:
        raise RosminiError(
            f"a map of {extent.width} x {extent.height} cells is too large: the robot is too far from the initial map, "
            "which xmin, ymin, xmax and ymax give"
        )
    cells = np.full((extent.height, extent.width), -1, dtype=np.int8)
    row, column = seen.row - extent.row, seen.column - extent.column
    part = cells[row : row + seen.height, column : column + seen.width]
    part[shares >= 0] = 0
    part[shares > threshold] = 100
    return cells, extent


def known(slam: GridSlam, particle: int) -> tuple[NDArray[np.float64], Extent]:
    """Return the occupancy (h, w) of a particle's map, -1 where unknown, cropped to the known cells, and its extent."""
    shares, _ = slam.maps.occupancy(particle)
    rows, columns = np.flatnonzero((shares >= 0).any(axis=1)), np.flatnonzero((shares >= 0).any(axis=0))
    if not len(rows):
        return shares[:0, :0], Extent(0, 0, 0, 0)
    top, right = rows[-1] + 1, columns[-1] + 1
    left, low = slam.maps.low
    extent = Extent(left + int(columns[0]), low + int(rows[0]), int(right - columns[0]), int(top - rows[0]))
    return shares[rows[0] : top, columns[0] : right], extent
