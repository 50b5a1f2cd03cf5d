"""The distance of each cell to the plan, or to the point where the plan leaves the costmap: `MapGrid`.

A wavefront spreads from the target cells across shared cell edges; obstacles stop it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import NO_INFORMATION, Costmap2D, Ints
from rosmini.navigation.kernels import kernel

Distances = NDArray[np.int32]
Floats = NDArray[np.float64]

INSCRIBED = 253
"""Cells of at least this cost stop the wavefront; a constant in the compiled code."""


def wavefront(
    costs: NDArray[np.uint8], within: NDArray[np.uint8], distances: Distances, queue: NDArray[np.int32], count: int
) -> None:
    """Spread distances (h, w) [cells] from the first `count` cell indices in `queue` (h w), which have distance 0.

    All other cells start with distance h w + 1, and keep it if they are unreachable; obstacles get h w. Cells marked in
    `within` (h, w), under the robot, are never obstacles.
    """
    height, width = costs.shape
    size = height * width
    head, tail = 0, count
    while head < tail:
        cell = queue[head]
        head += 1
        my, mx = cell // width, cell % width
        near = distances[my, mx] + 1
        for side in range(4):
            nx = mx + (-1 if side == 0 else 1 if side == 1 else 0)
            ny = my + (-1 if side == 2 else 1 if side == 3 else 0)
            if nx < 0 or ny < 0 or nx >= width or ny >= height or distances[ny, nx] <= size:
                continue
            if costs[ny, nx] >= INSCRIBED and within[ny, nx] == 0:
                distances[ny, nx] = size
                continue
            distances[ny, nx] = near
            queue[tail] = ny * width + nx
            tail += 1


@kernel(wavefront)
def compiled_wavefront(numba: Any) -> Any:
    """Return `wavefront`, compiled if numba is available; the body returns its signature for the decorator."""
    read = numba.types.Array(numba.uint8, 2, "C", readonly=True)
    return numba.void(read, read, numba.int32[:, ::1], numba.int32[::1], numba.int64)


@dataclass(frozen=True)
class MapGrid:
    """Distances [cells] of all cells (h, w) to the cells `targets` (n, 2), given as (mx, my)."""

    distances: Distances
    targets: Ints

    @property
    def obstacle(self) -> int:
        """The distance value of obstacles."""
        return int(self.distances.size)

    @property
    def unreachable(self) -> int:
        """The distance value of unreachable cells."""
        return int(self.distances.size) + 1


def densified(points: Floats, resolution: float) -> Floats:
    """Return a plan (n, 2 or more columns) with points inserted so that no gap exceeds `resolution` [m]."""
    if len(points) < 2:
        return points
    steps = np.diff(points, axis=0)
    squares = steps[:, 0] ** 2 + steps[:, 1] ** 2
    parts = np.where(squares > resolution * resolution, np.ceil(np.sqrt(squares) / resolution), 1).astype(np.intp)
    if int(parts.max()) == 1:
        return points
    starts = np.repeat(np.arange(len(parts)), parts)
    within = np.arange(len(starts)) - np.repeat(np.cumsum(parts) - parts, parts)
    made = points[starts] + within[:, None] * (steps / parts[:, None])[starts]
    return np.vstack([made, points[-1:]])


def plan_cells(grid: Costmap2D, plan: Floats) -> Ints:
    """Return the cells (n, 2), as (mx, my), of the first part of a plan (n, 2) on known cells of the costmap."""
    points = densified(plan[:, :2], grid.resolution)
    cells = np.floor((points - np.asarray(grid.origin)) / grid.resolution).astype(np.int64)
    inside = np.all((cells >= 0) & (cells < (grid.width, grid.height)), axis=1)
    inside[inside] = grid.costs[cells[inside, 1], cells[inside, 0]] != NO_INFORMATION
    if not inside.any():
        return np.empty((0, 2), dtype=np.int64)
    first = int(np.argmax(inside))
    outside = np.flatnonzero(~inside[first:])
    return np.asarray(cells[first : first + int(outside[0]) if len(outside) else None])


def grid_from(grid: Costmap2D, targets: Ints, within: Ints | None = None) -> MapGrid:
    """Return the distances to the cells `targets` (n, 2), as `MapGrid::setTargetCells` and `setLocalGoal` do.

    `within` (n, 2) are the cells (mx, my) under the robot, which never stop the wavefront.
    """
    size = grid.width * grid.height
    distances: Distances = np.full((grid.height, grid.width), size + 1, dtype=np.int32)
    inside = np.zeros((grid.height, grid.width), dtype=np.uint8)
    if within is not None and len(within):
        inside[within[:, 1], within[:, 0]] = 1
    queue = np.empty(size, dtype=np.int32)
    flat = distances.reshape(-1)
    flat[targets[:, 1] * grid.width + targets[:, 0]] = 0
    starts = np.flatnonzero(flat == 0)
    queue[: len(starts)] = starts
    compiled_wavefront()(np.ascontiguousarray(grid.costs), inside, distances, queue, len(starts))
    return MapGrid(distances, targets)
