"""How far cells are from the nearest occupied one, and how far a beam goes until it meets one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Table = NDArray[np.float32]

NUDGE = 1e-4
"""A beam goes so much [cells] past the border of a cell, so that rounding does not leave it before the border."""
ROUNDING = 2e-6
"""And so much of its longest way, which is a few times what `float32` rounds."""
UPRIGHT = 1e-7
"""What moves a beam by less sideways [cells a cell] moves it nowhere."""
CORNER = 1.4143
"""From the middle of a cell to its corner, and from the nearest blocked cell's middle to its corner [cells]."""
SHARE = 0.4
"""Beams that have ended are taken out of the arrays when so many have, since taking out costs as much as a step."""
ROUNDS = 8
"""Or after so many steps."""


def distances(occupied: Bools, farthest: int) -> NDArray[np.float32]:
    """The exact distance of each cell (h, w) from the middle of the nearest occupied one [cells], at most `farthest`.

    By rows, then by columns: a squared distance is the least of squares along the row plus squares along the column.
    """
    height, width = occupied.shape
    limit = farthest + 1
    # Narrow numbers, if the largest sum of two squares fits: on a large map the time goes into moving memory.
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
    """How far a beam may go from anywhere in a cell without a look [cells]; -1 where it ends.

    Shape (h + 2, w + 2): the map has a border at which beams end, too.
    """
    walled = np.pad(blocked, 1, constant_values=True)
    free = np.maximum(distances(walled, farthest) - CORNER, 0.0)
    return np.where(walled, -1.0, free).astype(np.float32)


def march(clear: Table, poses: Floats, bearings: Floats, limit: float) -> Floats:
    """How far (n, b) [cells] beams go from poses (n, 3) [cells, cells, rad] at bearings [rad], at most `limit`.

    All beams take a step at once: as far as is surely free, or else up to the border of the cell (sphere tracing, Hart
    1996, on a grid). So it is exact up to corners that a beam cuts by less than `NUDGE`.
    """
    width, beams = clear.shape[1], len(bearings)
    rays, base = rays_from(clear.shape, poses, bearings, NUDGE + ROUNDING * limit)
    longest, table = np.float32(limit), clear.ravel()
    gone, index = np.zeros(len(base), dtype=np.float32), np.arange(len(base))
    found, rounds = np.full(len(base), longest), 0
    while len(index):
        at = rays[:2] * gone
        at += rays[2:4]
        cell = np.floor(at)
        column, row = cell.astype(np.int32)
        free = table.take(base + row * width + column)
        at -= cell
        np.subtract(rays[4:6], at, out=at)
        at *= rays[6:]
        step = np.minimum(at[0], at[1])
        np.maximum(step, free, out=step)
        done = (free < 0) | (gone >= longest)
        step[done] = 0
        gone += step
        rounds += 1
        if rounds % ROUNDS == 0 or np.count_nonzero(done) > SHARE * len(done):
            found[index[done]] = gone[done]
            kept = np.flatnonzero(~done)
            index, base, gone, rays = index[kept], base[kept], gone[kept], rays.take(kept, axis=1)
    return np.minimum(found, longest).astype(np.float64).reshape(len(poses), beams)


def rays_from(
    shape: tuple[int, ...], poses: Floats, bearings: Floats, nudge: float
) -> tuple[Table, NDArray[np.int32]]:
    """What `march` needs of each beam: (8, n b), two rows each, and the index (n b,) of the cell where it starts.

    Rows: direction; start within its cell; where in a cell a beam leaves it, which is `nudge` past the border; and the
    reciprocal of the direction.
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
    direction[np.abs(direction) < UPRIGHT] = UPRIGHT
    rays[2:4] = np.repeat((poses[:, :2] - low).T, len(bearings), axis=1)
    rays[4:6] = np.where(direction > 0, 1 + nudge, -nudge)
    rays[6:] = 1 / direction
    return rays, np.repeat(cells, len(bearings))
