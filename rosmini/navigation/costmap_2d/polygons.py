"""Filling convex polygons in a costmap."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .costmap import Costmap2D

Cell = tuple[int, int]


def outline_spans(cells: list[Cell]) -> dict[int, Cell]:
    """Return the lowest and highest row of a polygon's outline, keyed by column; `cells` (mx, my) hold the vertices.

    The edges are Bresenham lines, as in `rosmini.navigation.costmap_2d.rays`. For so few cells Python integers are
    faster than arrays.
    """
    spans: dict[int, Cell] = {}
    for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], *cells[:1]], strict=True):
        dx, dy = abs(x1 - x0), abs(y1 - y0)
        step_x, step_y = (1 if x1 >= x0 else -1), (1 if y1 >= y0 else -1)
        longer, shorter = max(dx, dy), min(dx, dy)
        aside = longer // 2
        for step in range(longer + 1):
            off = aside // longer if longer else 0
            x, y = (step, off) if dx >= dy else (off, step)
            x, y = x0 + step_x * x, y0 + step_y * y
            low, high = spans.get(x, (y, y))
            spans[x] = min(low, y), max(high, y)
            aside += shorter
    return spans


def fill(grid: Costmap2D, polygon: ArrayLike, cost: int) -> bool:
    """Set the cost of all cells in a convex polygon (n, 2) [m], including its outline.

    Returns False, and changes nothing, if a vertex is outside the grid.
    """
    cells = [grid.world_to_map(x, y) for x, y in np.asarray(polygon, dtype=np.float64).tolist()]
    inside = [cell for cell in cells if cell is not None]
    if not cells or len(inside) < len(cells):
        return False
    for column, (low, high) in outline_spans(inside).items():
        grid.costs[low : high + 1, column] = cost
    return True
