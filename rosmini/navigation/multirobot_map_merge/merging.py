"""Merging maps: each is placed at its robot's start pose, and where they overlap the highest occupancy is kept.

Maps with another resolution or rotation are resampled: each cell of the result takes the value of the cell that
contains its centre, so that no holes appear (http://wiki.ros.org/multirobot_map_merge).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.maps import GridMap
from rosmini.core.maps.grid_map import UNKNOWN, MapError

MAX_CELLS = 100_000_000
"""Maximum number of cells of a merged map; more indicate wrong poses."""


def merge(maps: Sequence[tuple[GridMap, Pose]]) -> GridMap:
    """Return one map, merged from several, with the cell size of the first.

    Args:
        maps: maps with the poses (x [m], y [m], yaw [rad]) of their frames in the frame of the result.

    Raises:
        MapError: there is no map, or the maps are so far apart that the result would exceed `MAX_CELLS` cells.

    """
    if not maps:
        raise MapError("there are no maps to merge")
    side = maps[0][0].resolution
    corners = np.concatenate([_corners(grid, compose(pose, grid.origin)) for grid, pose in maps])
    left, low = (math.floor(float(edge) / side + 1e-6) for edge in corners.min(axis=0))
    right, top = (math.ceil(float(edge) / side - 1e-6) for edge in corners.max(axis=0))
    width, height = max(right - left, 1), max(top - low, 1)
    if width * height > MAX_CELLS:
        raise MapError(
            f"the merged map would have {width} x {height} cells, more than {MAX_CELLS}: check the robots' init_pose"
        )
    cells = np.full((height, width), UNKNOWN, dtype=np.int8)
    for grid, pose in maps:
        _add_map(cells, grid, compose(pose, grid.origin), side, left, low)
    return GridMap(cells, side, (left * side, low * side, 0.0))


def _corners(grid: GridMap, origin: Pose) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return the four corners (4, 2) [m] of a map whose lower left corner and heading are `origin`."""
    height, width = grid.occupancy.shape
    reach = [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)]
    return np.array([compose(origin, (x * grid.resolution, y * grid.resolution, 0.0))[:2] for x, y in reach])


def _add_map(
    cells: np.ndarray[tuple[int, int], np.dtype[np.int8]], grid: GridMap, origin: Pose, side: float, left: int, low: int
) -> None:
    """Add a map to `cells` (h, w) of size `side` [m], whose lower left one has the index (`left`, `low`)."""
    corners = _corners(grid, origin) / side
    columns = slice(*_span(corners[:, 0], left, cells.shape[1]))
    rows = slice(*_span(corners[:, 1], low, cells.shape[0]))
    x = (np.arange(columns.start, columns.stop) + left + 0.5) * side
    y = (np.arange(rows.start, rows.stop) + low + 0.5) * side
    back_x, back_y, back = inverse(origin)
    cos, sin = math.cos(back), math.sin(back)
    mx = np.floor((back_x + cos * x[None, :] - sin * y[:, None]) / grid.resolution + 1e-6).astype(int)
    my = np.floor((back_y + sin * x[None, :] + cos * y[:, None]) / grid.resolution + 1e-6).astype(int)
    height, width = grid.occupancy.shape
    inside = (mx >= 0) & (mx < width) & (my >= 0) & (my < height)
    values = np.where(inside, grid.occupancy[my.clip(0, height - 1), mx.clip(0, width - 1)], UNKNOWN)
    np.maximum(cells[rows, columns], values, out=cells[rows, columns])


def _span(edges: np.ndarray[tuple[int], np.dtype[np.float64]], first: int, count: int) -> tuple[int, int]:
    """Return the index range that edges [cells] span, within a row of `count` cells that begins at `first`."""
    begin, end = math.floor(float(edges.min())) - first, math.ceil(float(edges.max())) - first
    return max(begin, 0), min(end, count)
