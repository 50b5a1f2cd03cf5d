"""The path from a cell down a potential to its origin, along the gradient or from cell to cell.

This is navfn's algorithm, which global_planner's gradient path shares. It moves half a cell at a time against the
gradient, interpolated between four cells. Where one of the eight neighbours was not reached, or the path returns to an
earlier point, it moves one cell to the lowest of the eight (http://wiki.ros.org/navfn).

Three defects of the originals are not copied. No step crosses a cell that was not reached, or passes between two such
cells that touch at a corner. The path starts in the goal's own cell, not in a neighbour, which may be behind a wall.
And if it circles in a hollow of the gradient, it continues from cell to cell until it is lower than before; the
originals stop there, navfn after 4 points for each column of the map.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

from .wave import HIGH

MAX_LEVEL_POINTS = 16
"""Number of points without a lower potential after which the path moves from cell to cell."""

FULL, STUCK = -1, -2
"""Results of `descend` if `path` has no more room, and if no neighbouring cell is lower."""


NORMAL, LAST, NONE_LOWER = range(3)
"""Kinds of steps."""


def slope(before: float, here: float, after: float, width: float) -> float:
    """Return the decrease of the potential across three adjacent cells, positive if it falls towards `after`.

    If the middle cell is unreached, return -`width` or +`width`, towards a reached neighbour, or 0 without one.
    """
    if here >= HIGH:
        if before < HIGH:
            return -width
        return width if after < HIGH else 0.0
    down = 0.0
    if before < HIGH:
        down += before - here
    if after < HIGH:
        down += here - after
    return down


def lowest_around(potential: NDArray[np.float32], n: int, width: int) -> int:
    """Return the index of the lowest of cell `n` and those neighbours that can be reached without cutting a corner.

    A step cuts a corner if it is diagonal and both cells beside it are unreached.
    """
    best = n
    for i in range(9):
        m = n + (i // 3 - 1) * width + i % 3 - 1
        if potential[m] < potential[best] and unreached_beside(potential, n, m, width) < 2:
            best = m
    return best


def unreached_beside(potential: NDArray[np.float32], n: int, m: int, width: int) -> int:
    """Return how many of the two cells beside a diagonal step from cell `n` to `m` are unreached; 0 for other steps."""
    row = 0
    if m - n > 1:
        row = width
    if n - m > 1:
        row = -width
    column = m - n - row
    if row == 0 or column == 0:
        return 0
    return int(potential[n + row] >= HIGH) + int(potential[n + column] >= HIGH)


def surrounded(potential: NDArray[np.float32], n: int, width: int) -> bool:
    """Return whether cell `n` and its eight neighbours were all reached."""
    highest = potential[n]
    for i in range(9):
        highest = max(highest, potential[n + (i // 3 - 1) * width + i % 3 - 1])
    return bool(highest < HIGH)


def down(potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float) -> tuple[float, float]:
    """Return the unit vector of descent at offset (dx, dy) [cells] from the centre of cell `n`.

    It is interpolated between `n` and its neighbours to the right, above, and above right; (0, 0) if all are level.
    """
    gx = gy = 0.0
    for corner in range(4):
        right, above = corner % 2, corner // 2
        m = n + right + above * width
        share = (dx if right else 1 - dx) * (dy if above else 1 - dy)
        sx = slope(potential[m - 1], potential[m], potential[m + 1], 254.0)
        sy = slope(potential[m - width], potential[m], potential[m + width], 254.0)
        norm = math.sqrt(sx * sx + sy * sy)
        if norm > 0:
            gx += share * sx / norm
            gy += share * sy / norm
    norm = math.sqrt(gx * gx + gy * gy)
    if norm == 0:
        return 0.0, 0.0
    return gx / norm, gy / norm


def step_down(
    potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float
) -> tuple[int, int, float, float]:
    """Move half a cell against the gradient, from the offset (dx, dy) [cells] to the centre of cell `n`.

    Return `NORMAL` and the new cell and offset; or `NONE_LOWER` and the old ones if nothing leads down, or only into
    an unreached cell.
    """
    gx, gy = down(potential, n, width, dx, dy)
    to_x, to_y = dx + 0.5 * gx, dy + 0.5 * gy
    near = n + math.floor(to_x + 0.5) + math.floor(to_y + 0.5) * width
    if (gx == 0 and gy == 0) or potential[near] >= HIGH:
        return NONE_LOWER, n, dx, dy
    if to_x > 1:
        n, to_x = n + 1, to_x - 1
    if to_x < -1:
        n, to_x = n - 1, to_x + 1
    if to_y > 1:
        n, to_y = n + width, to_y - 1
    if to_y < -1:
        n, to_y = n - width, to_y + 1
    return NORMAL, n, to_x, to_y


def step_to_lowest(potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float) -> tuple[int, int]:
    """Move to the centre of the lowest neighbour, or first of this cell if an unreached cell is beside the step.

    Return `NORMAL`, or `NONE_LOWER` at the centre of a cell without a lower neighbour, and the new cell.
    """
    centred = dx == 0 and dy == 0
    n += math.floor(dx + 0.5) + math.floor(dy + 0.5) * width
    m = lowest_around(potential, n, width)
    if m == n and centred:
        return NONE_LOWER, n
    return NORMAL, m if centred or unreached_beside(potential, n, m, width) == 0 else n


def descend(
    potential: NDArray[np.float32],
    width: int,
    begin_x: float,
    begin_y: float,
    end_x: float,
    end_y: float,
    gradient: int,
    path: NDArray[np.float64],
) -> int:
    """Walk from `begin` to `end`, where the potential is 0, and write the points into `path`.

    Args:
        potential: the potential of the cells, row by row; the outermost cells must be unreached.
        width: number of cells in a row.
        begin_x: column of the first point; whole numbers are cell centres.
        begin_y: row of the first point.
        end_x: column of the last point.
        end_y: row of the last point.
        gradient: 1 to follow the gradient, 0 to move from cell to cell.
        path: receives the points' columns and rows, interleaved [2 n].

    Returns:
        The number of points, `FULL` or `STUCK`.

    """
    n = math.floor(begin_y + 0.5) * width + math.floor(begin_x + 0.5)
    dx, dy = begin_x - n % width, begin_y - n // width
    end = math.floor(end_y + 0.5) * width + math.floor(end_x + 0.5)
    # If the end lies between cells, two of them may be as far away as this.
    reach = 0.5 if end % width == end_x and end // width == end_y else 0.5 + 1e-6
    least, level_points = HIGH, 0
    kind = NORMAL
    for k in range(path.shape[0] // 2 - 1):
        x, y = n % width + dx, n // width + dy
        path[2 * k], path[2 * k + 1] = x, y
        near = math.floor(y + 0.5) * width + math.floor(x + 0.5)
        close = abs(x - end_x) < reach and abs(y - end_y) < reach
        if kind == LAST or (close and unreached_beside(potential, near, end, width) == 0):
            # The last point replaces this one, unless the line to it might cross a cell that was not reached.
            keep = (x != end_x or y != end_y) and (k == 0 or not surrounded(potential, near, width))
            last = k + 1 if keep else k
            path[2 * last], path[2 * last + 1] = end_x, end_y
            return last + 1
        if potential[n] < least:
            least, level_points = potential[n], 0
        level_points += 1
        back = k > 1 and path[2 * k - 4] == x and path[2 * k - 3] == y
        if gradient != 0 and not back and level_points < MAX_LEVEL_POINTS and surrounded(potential, n, width):
            kind, n, dx, dy = step_down(potential, n, width, dx, dy)
            if kind == NORMAL:
                continue
        kind, n = step_to_lowest(potential, n, width, dx, dy)
        dx, dy = 0.0, 0.0
        if kind == NONE_LOWER:
            # The end may lie between this cell and its neighbour if both have the same potential.
            if abs(n % width - end_x) >= 1 or abs(n // width - end_y) >= 1:
                return STUCK
            kind = LAST
    return FULL


@kernel(descend, slope, down, unreached_beside, lowest_around, surrounded, step_down, step_to_lowest)
def compiled_descend(numba: Any) -> Any:
    """Return `descend`, compiled if numba is available; the body returns its signature for the decorator."""
    types = numba.types
    number, real = types.int64, types.float64
    return number(types.float32[::1], number, real, real, real, real, number, types.float64[::1])
