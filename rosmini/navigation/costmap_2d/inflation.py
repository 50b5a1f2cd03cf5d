"""Inflation: costs that rise towards obstacles (http://wiki.ros.org/costmap_2d#Inflation).

The cost as a function of the distance d to the nearest lethal cell, measured between cell centres:

| d | cost |
|---|---|
| 0 | 254 |
| at most the inscribed radius | 253 |
| at most the inflation radius | 252 exp(-cost_scaling_factor (d - inscribed radius)), truncated |

The inflation radius is rounded up to whole cells. The distances are exact; those of costmap_2d's propagation are off by
a fraction of a cell in a few places. The loops are vectorised with numpy, which is as fast here as compiled code.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .costmap import INSCRIBED_INFLATED_OBSTACLE, LETHAL_OBSTACLE, NO_INFORMATION, Costs
from .layer import Window

BATCH_CELLS = 300_000
"""Number of cells processed at a time."""


def cell_distance(distance: float, resolution: float) -> int:
    """Return a distance [m] in cells, rounded up."""
    return max(0, math.ceil(distance / resolution))


def cost_at(distance: float, inscribed_radius: float, cost_scaling_factor: float) -> int:
    """Return the cost at a distance [m] from the nearest lethal cell, without regard to the inflation radius."""
    if distance == 0:
        return LETHAL_OBSTACLE
    if distance <= inscribed_radius:
        return INSCRIBED_INFLATED_OBSTACLE
    return int((INSCRIBED_INFLATED_OBSTACLE - 1) * math.exp(-cost_scaling_factor * (distance - inscribed_radius)))


def cost_table(radius: int, resolution: float, inscribed_radius: float, cost_scaling_factor: float) -> Costs:
    """Return the cost for each squared distance [cells] up to that of `radius`, then a 0 for all greater distances."""
    costs = [
        cost_at(math.sqrt(squared) * resolution, inscribed_radius, cost_scaling_factor)
        for squared in range(radius * radius + 1)
    ]
    return np.array([*costs, 0], dtype=np.uint8)


def squared_distances(lethal: NDArray[np.bool_], radius: int) -> NDArray[Any]:
    """Return each cell's squared distance [cells] (h, w) to the nearest lethal cell, or radius² + 1 beyond `radius`.

    The result is exact. The first pass works along the rows in steps of 1, 2, 4 ... cells, which add up to any distance
    up to `radius`; the second takes, over all row offsets, the smallest sum of the two squares.
    """
    far = radius * radius + 1
    # Sums reach radius² + far: the smallest integer type that can hold them is the fastest.
    kind = np.uint8 if far + radius * radius <= 255 else np.uint16 if radius < 181 else np.uint32
    along: NDArray[Any] = np.where(lethal, kind(0), kind(radius + 1))
    reach = 0
    while reach < radius:
        step = min(max(1, reach), radius - reach)
        reach += step
        more = along + kind(step)
        np.minimum(along[:, step:], more[:, :-step], out=along[:, step:])
        np.minimum(along[:, :-step], more[:, step:], out=along[:, :-step])
    squared = np.minimum(along * along, kind(far)) if far <= np.iinfo(kind).max else along * along
    result = squared.copy()
    for rows in range(1, min(radius, len(squared) - 1) + 1):
        more = squared + kind(rows * rows)
        np.minimum(result[rows:], more[:-rows], out=result[rows:])
        np.minimum(result[:-rows], more[rows:], out=result[:-rows])
    capped: NDArray[Any] = np.minimum(result, kind(far))
    return capped


def inflate(costs: Costs, window: Window, radius: int, table: Costs, *, inflate_unknown: bool = False) -> None:
    """Write the inflation costs into a window of a grid (h, w), in place.

    Lethal cells up to `radius` cells outside the window are included. A cell keeps its cost if that is greater; an
    unknown cell is overwritten only by 253 and 254, or with `inflate_unknown` by any cost above 0.
    """
    if radius <= 0 or window.is_empty:
        return
    rows = max(4 * radius, BATCH_CELLS // (window.xn - window.x0))
    for first in range(window.y0, window.yn, rows):
        band = Window(window.x0, first, window.xn, min(first + rows, window.yn))
        _inflate_band(costs, band, radius, table, inflate_unknown)


def _inflate_band(costs: Costs, window: Window, radius: int, table: Costs, inflate_unknown: bool) -> None:
    """Inflate a band of rows that fits into the cache. No cell becomes lethal, so bands do not affect each other."""
    height, width = costs.shape
    x0, y0 = max(window.x0 - radius, 0), max(window.y0 - radius, 0)
    lethal = costs[y0 : min(window.yn + radius, height), x0 : min(window.xn + radius, width)] == LETHAL_OBSTACLE
    if not lethal.any():
        return
    inner = np.s_[window.y0 - y0 : window.yn - y0, window.x0 - x0 : window.xn - x0]
    added = np.take(table, squared_distances(lethal, radius)[inner])
    old = window.view(costs)
    least = 1 if inflate_unknown else INSCRIBED_INFLATED_OBSTACLE
    learnt = (old == NO_INFORMATION) & (added >= least)
    np.maximum(old, added, out=old)
    np.copyto(old, added, where=learnt)
