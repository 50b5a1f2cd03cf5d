"""Distances from cells to the nearest occupied cell, and ranges of beams until they hit an occupied cell."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Table = NDArray[np.float32]

BORDER_STEP = 1e-4
"""A beam steps this distance [cells] past the border of a cell, so that rounding does not keep it in the cell."""
RANGE_ROUNDING = 2e-6
"""Additional step past the border, as a fraction of the maximum range: a few rounding errors of `float32`."""
MIN_DIRECTION = 1e-7
"""Minimum absolute value of a beam's direction along each axis, which avoids dividing by zero."""
CORNER_DISTANCE = 1.4143
"""Half a cell diagonal in the beam's cell plus half of one in the nearest blocked cell [cells]."""
REMOVAL_FRACTION = 0.4
"""Fraction of finished beams at which they are removed from the arrays; removing costs as much as a step."""
REMOVAL_STEPS = 8
"""Number of steps after which finished beams are removed in any case."""


def distances(occupied: Bools, farthest: int) -> NDArray[np.float32]:
    """Return the exact distance of each cell (h, w) from the centre of the nearest occupied cell [cells].

    Distances above `farthest` [cells] are replaced by it. A squared distance is the minimum, over the cells of the
    column, of the squared distance along the row plus that along the column.
    """
    height, width = occupied.shape
    limit = farthest + 1
    # Use a narrow integer type if the largest sum of two squares fits: on a large map memory traffic takes the time.
    small = np.uint16 if 2 * limit * limit < 1 << 16 else np.int32
    row = np.full((height, width), limit, dtype=small)
    row[occupied] = 0
    for column in range(1, width):
        np.minimum(row[:, column], row[:, column - 1] + 1, out=row[:, column])
    for column in range(width - 2, -1, -1):
        np.minimum(row[:, column], row[:, column + 1] + 1, out=row[:, column])
    squares = np.minimum(row, limit) ** 2
    best = squares.copy()
    for step in range(1, min(farthest, height - 1) + 1):
        more = step * step
        np.minimum(best[step:], squares[:-step] + more, out=best[step:])
        np.minimum(best[:-step], squares[step:] + more, out=best[:-step])
    found: NDArray[np.float32] = np.sqrt(np.minimum(best, farthest * farthest), dtype=np.float32)
    return found


def clearances(blocked: Bools, farthest: int) -> Table:
    """Return the distance that a beam can travel from any point in a cell without a hit [cells]; -1 in blocked cells.

    The map (h, w) gets a blocked border, so the result has the shape (h + 2, w + 2).
    """
    walled = np.pad(blocked, 1, constant_values=True)
    free = np.maximum(distances(walled, farthest) - CORNER_DISTANCE, 0.0)
    return np.where(walled, -1.0, free).astype(np.float32)


def cast_beams(clear: Table, poses: Floats, bearings: Floats, limit: float) -> Floats:
    """Return the ranges (n, b) [cells] of beams from poses (n, 3) [cells, cells, rad] at bearings [rad], up to `limit`.

    All beams step at once: by the distance that is certainly free, or else to the border of the cell (sphere tracing,
    Hart 1996, on a grid). The result is exact except where a beam cuts a corner by less than `BORDER_STEP`.
    """
    width, beams = clear.shape[1], len(bearings)
    rays, base = rays_from(clear.shape, poses, bearings, BORDER_STEP + RANGE_ROUNDING * limit)
    longest, table = np.float32(limit), clear.ravel()
    travelled, index = np.zeros(len(base), dtype=np.float32), np.arange(len(base))
    found, rounds = np.full(len(base), longest), 0
    while len(index):
        at = rays[:2] * travelled
        at += rays[2:4]
        cell = np.floor(at)
        column, row = cell.astype(np.int32)
        free = table.take(base + row * width + column)
        at -= cell
        np.subtract(rays[4:6], at, out=at)
        at *= rays[6:]
        step = np.minimum(at[0], at[1])
        np.maximum(step, free, out=step)
        done = (free < 0) | (travelled >= longest)
        step[done] = 0
        travelled += step
        rounds += 1
        if rounds % REMOVAL_STEPS == 0 or np.count_nonzero(done) > REMOVAL_FRACTION * len(done):
            found[index[done]] = travelled[done]
            kept = np.flatnonzero(~done)
            index, base, travelled, rays = index[kept], base[kept], travelled[kept], rays.take(kept, axis=1)
    return np.minimum(found, longest).astype(np.float64).reshape(len(poses), beams)


def rays_from(shape: tuple[int, ...], poses: Floats, bearings: Floats, nudge: float) -> tuple[Table, NDArray[np.int32]]:
    """Return the values that `cast_beams` needs for each beam (8, n b), and the index (n b,) of its first cell.

    The rows are pairs of x and y: direction; start within the cell; coordinate at which a beam leaves a cell, which is
    `nudge` past the border; reciprocal of the direction.
    """
    height, width = shape
    low = np.floor(poses[:, :2])
    rows, columns = low[:, 1] + 1, low[:, 0] + 1
    outside = (rows < 1) | (rows > height - 2) | (columns < 1) | (columns > width - 2)
    cells = np.where(outside, 0, rows * width + columns).astype(np.int32)
    angles = (poses[:, 2, None] + bearings).ravel()
    rays = np.empty((8, len(angles)), dtype=np.float32)
    rays[0], rays[1] = np.cos(angles), np.sin(angles)
    direction = rays[:2]
    direction[np.abs(direction) < MIN_DIRECTION] = MIN_DIRECTION
    rays[2:4] = np.repeat((poses[:, :2] - low).T, len(bearings), axis=1)
    rays[4:6] = np.where(direction > 0, 1 + nudge, -nudge)
    rays[6:] = 1 / direction
    return rays, np.repeat(cells, len(bearings))
