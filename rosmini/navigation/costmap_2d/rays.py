"""Rays on a grid: the cells of a line, and clearing cells along beams.

Lines are Bresenham lines: one cell per step along the longer axis, and on the shorter axis the cell nearest to the line
between the centres of the end cells.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

Ints = NDArray[np.int64]


def line_cells(x0: int, y0: int, x1: int, y1: int) -> tuple[Ints, Ints]:
    """Return the columns (n) and rows (n) of the cells on a line, including both ends."""
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    longer, shorter = max(dx, dy), min(dx, dy)
    along = np.arange(longer + 1)
    aside = (along * shorter + longer // 2) // max(longer, 1)
    a, b = (along, aside) if dx >= dy else (aside, along)
    return x0 + a * (1 if x1 >= x0 else -1), y0 + b * (1 if y1 >= y0 else -1)


def clip_end(
    ox: float, oy: float, wx: float, wy: float, x0: float, y0: float, x1: float, y1: float
) -> tuple[float, float]:
    """Return the end of a ray from (ox, oy) to (wx, wy), clipped to the rectangle from (x0, y0) to (x1, y1)."""
    a, b = wx - ox, wy - oy
    if wx < x0:
        wx, wy = x0, oy + b * ((x0 - ox) / a)
    if wy < y0:
        wx, wy = ox + a * ((y0 - oy) / b), y0
    if wx > x1:
        wx, wy = x1 - 0.001, oy + b * ((x1 - ox) / a)
    if wy > y1:
        wx, wy = ox + a * ((y1 - oy) / b), y1 - 0.001
    return wx, wy


def clear_rays(
    costs: Any,
    origin_x: float,
    origin_y: float,
    resolution: float,
    ox: float,
    oy: float,
    points: Any,
    reach: int,
    value: int,
) -> tuple[int, int, int, int]:
    """Write `value` into the cells from a sensor to each observed point, including the point's cell.

    Args:
        costs: the grid (h, w), modified in place.
        origin_x: the left edge of the grid [m].
        origin_y: the lower edge of the grid [m].
        resolution: the side of a cell [m].
        ox: the sensor's x [m]; the sensor must be inside the grid.
        oy: the sensor's y [m].
        points: the observed points (n, 3) [m], in the grid's frame.
        reach: maximum length of a cleared ray [cells].
        value: the cost to write.

    Returns:
        The first column, first row, last column and last row that were written.

    """
    height, width = costs.shape
    end_x, end_y = origin_x + width * resolution, origin_y + height * resolution
    x0 = math.floor((ox - origin_x) / resolution)
    y0 = math.floor((oy - origin_y) / resolution)
    low_x, high_x, low_y, high_y = x0, x0, y0, y0
    for n in range(points.shape[0]):
        px, py = points[n, 0], points[n, 1]
        if not (math.isfinite(px) and math.isfinite(py)):
            continue
        wx, wy = clip_end(ox, oy, px, py, origin_x, origin_y, end_x, end_y)
        x1 = math.floor((wx - origin_x) / resolution)
        y1 = math.floor((wy - origin_y) / resolution)
        if x1 < 0 or y1 < 0 or x1 >= width or y1 >= height:
            continue
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        step_x, step_y = (1 if x1 >= x0 else -1), (1 if y1 >= y0 else -1)
        along_x = dx >= dy
        longer, shorter = (dx, dy) if along_x else (dy, dx)
        length = math.sqrt(float(dx * dx + dy * dy))
        last = longer if length <= reach else int(reach / length * longer)
        error = longer // 2
        x, y = x0, y0
        costs[y, x] = value
        for _ in range(last):
            error += shorter
            aside = error >= longer
            if aside:
                error -= longer
            if along_x or aside:
                x += step_x
            if aside or not along_x:
                y += step_y
            costs[y, x] = value
        low_x, high_x = min(low_x, x), max(high_x, x)
        low_y, high_y = min(low_y, y), max(high_y, y)
    return low_x, low_y, high_x, high_y


@kernel(clear_rays, clip_end)
def compiled_clear_rays(numba: Any) -> Any:
    """Return `clear_rays`, compiled if numba is available; the body returns its signature for the decorator."""
    types = numba.types
    number, real = types.int64, types.float64
    return types.UniTuple(number, 4)(
        types.uint8[:, ::1], real, real, real, real, real, types.float64[:, ::1], number, types.uint8
    )
