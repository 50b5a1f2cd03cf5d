"""From a cell down a potential to where it began: the path, by its gradient or from cell to cell.

The walk is navfn's, which global_planner's gradient path shares: half a cell at a time against the gradient, which is
interpolated between four cells; and where one of the eight cells around was not reached, or the walk goes back,
one cell on to the lowest of the eight (http://wiki.ros.org/navfn).

Three defects of the originals are not copied. No step crosses a cell that was not reached, or passes between two such
cells that touch at a corner. A walk begins in the goal's own cell, not in one beside it, which may lie beyond a wall.
And one that goes round in a hollow of the gradient goes on from cell to cell until it is lower than before, where the
originals stop, navfn after 4 points for each column of the map.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import machine_code

from .wave import HIGH

PATIENCE = 16
"""After so many points without a lower potential the walk goes from cell to cell."""

FULL, STUCK = -1, -2
"""What `descend` returns when the path has no more room, and when no cell around is lower."""


PLAIN, LAST, NONE_LOWER = range(3)
"""Steps of the walk."""


def slope(before: float, here: float, after: float, width: float) -> float:
    """The descent through three cells in a row; `width` if this cell was not reached, towards one that was."""
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
    """The lowest of a cell and the eight around it, without passing between two cells that were not reached."""
    best = n
    for i in range(9):
        m = n + (i // 3 - 1) * width + i % 3 - 1
        if potential[m] < potential[best] and walls_beside(potential, n, m, width) < 2:
            best = m
    return best


def walls_beside(potential: NDArray[np.float32], n: int, m: int, width: int) -> int:
    """How many of the two cells beside a diagonal step from `n` to `m` were not reached; 0 for another step."""
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
    """Whether a cell and the eight around it were all reached."""
    highest = potential[n]
    for i in range(9):
        highest = max(highest, potential[n + (i // 3 - 1) * width + i % 3 - 1])
    return bool(highest < HIGH)


def down(potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float) -> tuple[float, float]:
    """The direction down, interpolated between the four cells from `n` on; (0, 0) where there is none."""
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


def slide(
    potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float
) -> tuple[int, int, float, float]:
    """Half a cell down from (dx, dy) off the middle of `n`: `PLAIN` and the new cell and offsets, if that leads on."""
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
    return PLAIN, n, to_x, to_y


def hop(potential: NDArray[np.float32], n: int, width: int, dx: float, dy: float) -> tuple[int, int]:
    """The middle of the lowest cell around; of this one first, if the way there passes a cell that was not reached."""
    centred = dx == 0 and dy == 0
    n += math.floor(dx + 0.5) + math.floor(dy + 0.5) * width
    m = lowest_around(potential, n, width)
    if m == n and centred:
        return NONE_LOWER, n
    return PLAIN, m if centred or walls_beside(potential, n, m, width) == 0 else n


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
        potential: of the cells, row after row; the outermost were not reached.
        width: cells in a row.
        begin_x: column of the first point; a whole number is the middle of a cell.
        begin_y: row of the first point.
        end_x: column of the last point.
        end_y: row of the last point.
        gradient: whether to follow the gradient, or to go from cell to cell.
        path: the points' columns and rows, one after another [2 n].

    Returns:
        The number of points, `FULL` or `STUCK`.

    """
    n = math.floor(begin_y + 0.5) * width + math.floor(begin_x + 0.5)
    dx, dy = begin_x - n % width, begin_y - n // width
    end = math.floor(end_y + 0.5) * width + math.floor(end_x + 0.5)
    # An end between cells may be as far as this from two of them.
    reach = 0.5 if end % width == end_x and end // width == end_y else 0.5 + 1e-6
    least, since = HIGH, 0
    kind = PLAIN
    for k in range(path.shape[0] // 2 - 1):
        x, y = n % width + dx, n // width + dy
        path[2 * k], path[2 * k + 1] = x, y
        near = math.floor(y + 0.5) * width + math.floor(x + 0.5)
        close = abs(x - end_x) < reach and abs(y - end_y) < reach
        if kind == LAST or (close and walls_beside(potential, near, end, width) == 0):
            # The last point takes the place of this one, unless the way to it might cross a cell that was not reached.
            keep = (x != end_x or y != end_y) and (k == 0 or not surrounded(potential, near, width))
            last = k + 1 if keep else k
            path[2 * last], path[2 * last + 1] = end_x, end_y
            return last + 1
        if potential[n] < least:
            least, since = potential[n], 0
        since += 1
        back = k > 1 and path[2 * k - 4] == x and path[2 * k - 3] == y
        if gradient != 0 and not back and since < PATIENCE and surrounded(potential, n, width):
            kind, n, dx, dy = slide(potential, n, width, dx, dy)
            if kind == PLAIN:
                continue
        kind, n = hop(potential, n, width, dx, dy)
        dx, dy = 0.0, 0.0
        if kind == NONE_LOWER:
            # The end may lie just between this cell and the next, which costs the same.
            if abs(n % width - end_x) >= 1 or abs(n // width - end_y) >= 1:
                return STUCK
            kind = LAST
    return FULL


@cache
def compiled_descend() -> Callable[..., int]:
    """`descend` as machine code, or as it is without numba."""
    try:
        import numba
    except ImportError:
        return descend
    types: Any = numba.types
    number, real = types.int64, types.float64
    signature = number(types.float32[::1], number, real, real, real, real, number, types.float64[::1])
    return machine_code(
        descend, signature, (slope, down, walls_beside, lowest_around, surrounded, slide, hop)
    )
