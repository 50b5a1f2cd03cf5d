"""Rays over a grid: lines of cells, and what a beam clears.

Lines are Bresenham's: along the longer axis one cell after the other, along the shorter the cell nearest to the line
between the middles of both ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import machine_code

Ints = NDArray[np.int64]


def line_cells(x0: int, y0: int, x1: int, y1: int) -> tuple[Ints, Ints]:
    """The columns (n) and rows (n) of the cells of a line, both ends included."""
    dx, dy = abs(x1 - x0), abs(y1 - y0)
    longer, shorter = max(dx, dy), min(dx, dy)
    along = np.arange(longer + 1)
    aside = (along * shorter + longer // 2) // max(longer, 1)
    a, b = (along, aside) if dx >= dy else (aside, along)
    return x0 + a * (1 if x1 >= x0 else -1), y0 + b * (1 if y1 >= y0 else -1)


def clip_end(
    ox: float, oy: float, wx: float, wy: float, x0: float, y0: float, x1: float, y1: float
) -> tuple[float, float]:
    """The end of a ray from (ox, oy) to (wx, wy), moved along it into the rectangle from (x0, y0) to (x1, y1)."""
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
    """Write `value` into the cells between a sensor and each point that it saw, and into the point's own.

    Args:
        costs: the grid (h, w), changed in place.
        origin_x: the left edge of the grid [m].
        origin_y: its lower edge [m].
        resolution: of a cell [m].
        ox: the sensor, which is over the grid [m].
        oy: likewise.
        points: what it saw (n, 3) [m], in the grid's frame.
        reach: how far a ray clears [cells].
        value: the cost that is written.

    Returns:
        The first column and row that were written, and the last.

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


@cache
def compiled_clear_rays() -> Callable[..., tuple[int, int, int, int]]:
    """`clear_rays` as machine code, or without numba as it is."""
    try:
        import numba
    except ImportError:
        return clear_rays
    types: Any = numba.types
    number, real = types.int64, types.float64
    signature = types.UniTuple(number, 4)(
        types.uint8[:, ::1], real, real, real, real, real, types.float64[:, ::1], number, types.uint8
    )
    return machine_code(clear_rays, signature, (clip_end,))
