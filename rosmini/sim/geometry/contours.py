"""Outlines of the occupied cells of a grid, with few sides, accurate to half a cell.

First the edges of the cells are traced, with the occupied cells on the left: counter-clockwise around each blob,
clockwise around each hole. Cells that touch at a corner belong together (8-connected), as in a wall that a
mapper drew one cell thick, so no ray slips through between them. Then `staircases.straightened` replaces
staircases by long sides.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.poses import Pose, transform_points

from .staircases import straightened

Floats = NDArray[np.float64]
Loop = NDArray[np.int64]

MAX_CORNERS = 300_000
"""Maximum number of vertices of all outlines along the cells' edges."""

TOLERANCE = 0.49
"""Default distance by which an outline may deviate towards the centres of cells [cells]."""

_STEP = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])  # directions 0 to 3: each a quarter turn to the left


def trace(
    occupied: ArrayLike, resolution: float, origin: Pose = (0.0, 0.0, 0.0), tolerance: float | None = None
) -> Floats:
    """Return closed outlines of the occupied cells as segments (n, 4), each x1, y1, x2, y2 [m], cells on their left.

    `occupied` (h, w) is a mask; row 0 is the lowest. `resolution` is the side of a cell [m] and `origin` the pose of
    the lower left corner of cell (0, 0), as in nav_msgs/MapMetaData. Consecutive segments share exactly the same
    corner. See `outlines` for the guarantees.

    Raises `GeometryError` for an `occupied` that is not 2D, a resolution that is not positive, an origin that is
    not finite, or a `tolerance` [m] that is not at least 0 and below half a cell; by default it is 0.49 cells.
    """
    if not (math.isfinite(resolution) and resolution > 0):
        msg = f"the resolution is {resolution}; the side of a cell is more than 0 m"
        raise GeometryError(msg)
    if len(origin) != 3 or not all(map(math.isfinite, origin)):
        msg = f"the origin is {origin}; it is a pose of finite x, y and heading"
        raise GeometryError(msg)
    loops = outlines(occupied, TOLERANCE if tolerance is None else tolerance / resolution)
    sides = [np.hstack([loop, np.roll(loop, -1, axis=0)]) for loop in loops]
    ends = np.vstack(sides).reshape(-1, 2) if sides else np.empty((0, 2))
    return transform_points(origin, ends * resolution).reshape(-1, 4)


def outlines(occupied: ArrayLike, tolerance: float = TOLERANCE) -> list[Floats]:
    """Return closed outlines of the occupied cells, each the corners (k, 2) of one loop in cells, x along the rows.

    A loop passes between the same cells as the edges that it replaces, and no centre is closer to it than half a cell
    minus `tolerance` [cells]; with a tolerance of 0 it consists of the edges. So the centres of occupied cells are in
    it (by the even-odd rule and by the winding number), those of free cells are not, and separate cells remain
    separate. No point of a loop is half a cell away from the edges, and no edge half a cell's diagonal away from the
    loop: the corners of the staircase of a slanted wall stick out. Blobs of one cell remain, as squares.

    Raises `GeometryError` for an `occupied` that is not 2D or a `tolerance` that is not at least 0 and below half
    a cell.
    """
    if not 0 <= tolerance < 0.5:
        msg = f"the tolerance is {tolerance:.6g} cells; it is at least 0 and below half a cell"
        raise GeometryError(msg)
    return straightened(edge_loops(occupied), tolerance)


def edge_loops(occupied: ArrayLike) -> list[Loop]:
    """Return the closed outlines along the edges of the occupied cells, each the corners (k, 2) where it turns.

    Corners are integers [cells], x along the rows. The order is fixed: loops by their lowest, then leftmost
    corner. Raises `GeometryError` for an `occupied` that is not 2D, or with more than `MAX_CORNERS` vertices.
    """
    starts, directions, following = _edges(_mask(occupied))
    turning = directions[following] != directions
    count = np.count_nonzero(turning)
    if count > MAX_CORNERS:
        msg = f"the outlines of its dark or occupied parts have {count} vertices; {MAX_CORNERS} are allowed"
        raise GeometryError(msg)
    turns = turning.tolist()
    ends = (starts + _STEP[directions]).tolist()
    successors: list[int] = following.tolist()
    seen = bytearray(len(successors))
    loops = []
    for first in range(len(successors)):
        if seen[first]:
            continue
        corners, edge = [], first
        while not seen[edge]:
            seen[edge] = 1
            if turns[edge]:
                corners.append(ends[edge])
            edge = successors[edge]
        loops.append(np.array(corners, dtype=np.int64))
    return loops


def _mask(occupied: ArrayLike) -> NDArray[np.bool_]:
    cells = np.asarray(occupied)
    if cells.ndim != 2:
        msg = f"occupied is a table (h, w) of cells, not {cells.shape}"
        raise GeometryError(msg)
    return cells.astype(bool)


def _edges(cells: NDArray[np.bool_]) -> tuple[Loop, Loop, Loop]:
    """Return edges between an occupied cell, on the left, and a free one: start (n, 2), direction, next edge."""
    padded = np.pad(cells, 1)
    inner = padded[1:-1, 1:-1]
    neighbours = (padded[:-2, 1:-1], padded[1:-1, 2:], padded[2:, 1:-1], padded[1:-1, :-2])  # below, right, above, left
    width = cells.shape[1] + 1
    keys = []
    for direction, (neighbour, (dx, dy)) in enumerate(zip(neighbours, ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True)):
        rows, columns = np.nonzero(inner & ~neighbour)
        keys.append(((rows + dy) * width + columns + dx) * 4 + direction)
    edges = np.sort(np.concatenate(keys)).astype(np.int64)
    corners, directions = np.divmod(edges, 4)
    starts = np.stack([corners % width, corners // width], axis=1)
    ahead = ((starts + _STEP[directions]) * (1, width)).sum(axis=1)
    following = np.full(len(edges), -1, dtype=np.int64)
    # Where two occupied cells touch at a corner, two edges could be next: the right-hand one keeps the cells together.
    for turn in (1, 0, -1):
        wanted = ahead * 4 + (directions + turn) % 4
        place = np.minimum(np.searchsorted(edges, wanted), max(len(edges) - 1, 0))
        found = edges[place] == wanted
        following[found] = place[found]
    return starts, directions, following
