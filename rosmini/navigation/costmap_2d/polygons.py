"""Convex polygons over a grid of costs."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .costmap import Costmap2D, Ints
from .rays import line_cells


def outline_cells(cells: list[tuple[int, int]]) -> tuple[Ints, Ints]:
    """The columns and rows of the cells on the outline of a polygon whose vertices are in these cells, (mx, my)."""
    columns, rows = [], []
    for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], *cells[:1]], strict=True):
        xs, ys = line_cells(x0, y0, x1, y1)
        columns.append(xs)
        rows.append(ys)
    return np.concatenate(columns), np.concatenate(rows)


def fill(grid: Costmap2D, polygon: ArrayLike, cost: int) -> bool:
    """Give a cost to all cells of a convex polygon (n, 2) [m], its outline included.

    If a vertex is outside of the grid nothing changes, and the answer is False.
    """
    cells = [grid.world_to_map(float(x), float(y)) for x, y in np.asarray(polygon)]
    inside = [cell for cell in cells if cell is not None]
    if not cells or len(inside) < len(cells):
        return False
    columns, rows = outline_cells(inside)
    first = int(columns.min())
    low = np.full(int(columns.max()) - first + 1, grid.height, dtype=np.int64)
    high = np.full(len(low), -1, dtype=np.int64)
    np.minimum.at(low, columns - first, rows)
    np.maximum.at(high, columns - first, rows)
    bottom, top = int(rows.min()), int(rows.max())
    lines = np.arange(bottom, top + 1)[:, None]
    grid.costs[bottom : top + 1, first : first + len(low)][(lines >= low) & (lines <= high)] = cost
    return True
