"""Voxel columns, one per cell, with marked and unknown voxels, and clearing along rays (voxel_grid).

A column is an integer: bit z is set unless voxel z is known to be free, and bit 16 + z is set if voxel z is marked. A
voxel with only the first bit is unknown, with both bits marked, and with neither free.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

Columns = NDArray[np.int64]

BITS = 16
"""Maximum number of voxels in a column."""
UNKNOWN = (1 << BITS) - 1
"""A column whose voxels are all unknown."""


@cache
def _counts() -> NDArray[np.uint8]:
    """Return the number of set bits for each 16-bit integer (65536,)."""
    return np.array([number.bit_count() for number in range(1 << BITS)], dtype=np.uint8)


def marked_count(columns: Columns) -> NDArray[np.uint8]:
    """Return the number of marked voxels in each column (...)."""
    counts: NDArray[np.uint8] = _counts()[columns >> BITS]
    return counts


def mark_voxels(columns: Columns, mx: Any, my: Any, mz: Any) -> None:
    """Mark the voxels with columns `mx`, rows `my` and heights `mz` (n each) in `columns` (h, w), in place."""
    np.bitwise_or.at(columns, (my, mx), (1 << mz) | (1 << (mz + BITS)))


def bit_count(number: int) -> int:
    """Return the number of set bits of an integer of at least 0."""
    count = 0
    while number:
        number &= number - 1
        count += 1
    return count


def ray_fraction(value: float, start: float, low: float, high: float, share: float) -> float:
    """Return the fraction of a ray from `start` to `value` that is between `low` and `high` on one axis.

    The result is at most `share`.
    """
    if value < low:
        return min(share, (low - start) / (value - start))
    if value > high:
        return min(share, (high - start) / (value - start))
    return share


def clear_voxels(
    columns: Any,
    costs: Any,
    frame: Any,
    sensor: Any,
    points: Any,
    size_z: int,
    reach: int,
    mark_threshold: int,
    unknown_threshold: int,
) -> tuple[int, int, int, int]:
    """Clear the voxels from a sensor to two cells before each observed point, and update the costs of their columns.

    Args:
        columns: the voxel columns (h, w), modified in place.
        costs: the costs (h, w), modified in place: 0 if few voxels are marked and unknown, 255 if many are unknown.
        frame: the grid's left edge, lower edge and floor [m], the side of a cell and the height of a voxel [m], and
            the maximum obstacle height [m].
        sensor: the sensor's x, y, z [m], inside the grid.
        points: the observed points (n, 3) [m].
        size_z: number of voxels in a column.
        reach: maximum length of a cleared ray [cells].
        mark_threshold: maximum number of marked voxels in a free column.
        unknown_threshold: maximum number of unknown voxels in a free column, including those above `size_z`.

    Returns:
        The first column, first row, last column and last row that were passed.

    """
    height, width = costs.shape
    x0, y0, z0, side, tall, top = frame[0], frame[1], frame[2], frame[3], frame[4], frame[5]
    ox, oy, oz = sensor[0], sensor[1], sensor[2]
    start_x, start_y, start_z = (
        math.floor((ox - x0) / side),
        math.floor((oy - y0) / side),
        math.floor((oz - z0) / tall),
    )
    low_x, high_x, low_y, high_y = start_x, start_x, start_y, start_y
    for n in range(points.shape[0]):
        a, b, c = points[n, 0] - ox, points[n, 1] - oy, points[n, 2] - oz
        away = math.sqrt(a * a + b * b + c * c)
        if not math.isfinite(away) or away <= 0:
            continue
        short = max(min(1.0, (away - 2 * side) / away), 0.0)
        a, b, c = a * short, b * short, c * short
        share = 1.0
        if oz + c > top:
            share = max(0.0, min(share, (top - 0.01 - oz) / c))
        elif oz + c < z0:
            share = min(share, (z0 - oz) / c)
        share = ray_fraction(ox + a, ox, x0, x0 + width * side, share)
        share = ray_fraction(oy + b, oy, y0, y0 + height * side, share)
        x1 = math.floor((ox + a * share - x0) / side)
        y1 = math.floor((oy + b * share - y0) / side)
        z1 = math.floor((oz + c * share - z0) / tall)
        if x1 < 0 or y1 < 0 or z1 < 0 or x1 >= width or y1 >= height or z1 >= size_z:
            continue
        dx, dy, dz = abs(x1 - start_x), abs(y1 - start_y), abs(z1 - start_z)
        step_x, step_y, step_z = (1 if x1 >= start_x else -1, 1 if y1 >= start_y else -1, 1 if z1 >= start_z else -1)
        longest = max(dx, dy, dz)
        length = math.sqrt(float(dx * dx + dy * dy + dz * dz))
        last = longest if length <= reach else int(reach / length * longest)
        error_x = error_y = error_z = longest // 2
        x, y, z = start_x, start_y, start_z
        for step in range(last + 1):
            if step:
                error_x, error_y, error_z = error_x + dx, error_y + dy, error_z + dz
                if error_x >= longest:
                    error_x, x = error_x - longest, x + step_x
                if error_y >= longest:
                    error_y, y = error_y - longest, y + step_y
                if error_z >= longest:
                    error_z, z = error_z - longest, z + step_z
            column = columns[y, x] & ~((1 << z) | (1 << (z + 16)))
            columns[y, x] = column
            marked = column >> 16
            if bit_count(marked) <= mark_threshold:
                costs[y, x] = 0 if bit_count(marked ^ (column & 65535)) <= unknown_threshold else 255
        low_x, high_x = min(low_x, x), max(high_x, x)
        low_y, high_y = min(low_y, y), max(high_y, y)
    return low_x, low_y, high_x, high_y


@kernel(clear_voxels, bit_count, ray_fraction)
def compiled_clear_voxels(numba: Any) -> Any:
    """Return `clear_voxels`, compiled if numba is available; the body returns its signature for the decorator."""
    types = numba.types
    number, line = types.int64, types.float64[::1]
    return types.UniTuple(number, 4)(
        types.int64[:, ::1], types.uint8[:, ::1], line, line, types.float64[:, ::1], number, number, number, number
    )
