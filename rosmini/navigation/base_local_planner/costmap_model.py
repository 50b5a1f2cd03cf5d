"""The cost of a footprint at a pose: base_local_planner's `CostmapModel`.

As in the original only the outline is checked: an obstacle completely inside it is missed, but then the robot is
already on top of it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.geometry.poses import Pose
from rosmini.navigation.costmap_2d.costmap import Costmap2D

from .rollout import compiled_footprint_cost


def footprint_cost(grid: Costmap2D, pose: Pose, footprint: ArrayLike) -> int:
    """Return the largest cost on a footprint's outline (n, 2) [m, base frame] at `pose` (x [m], y [m], heading).

    Negative at an illegal pose: `HIT` (-1) on an obstacle, `UNSEEN` (-2) on an unknown cell, `OUTSIDE` (-3) outside the
    costmap. With fewer than three vertices the robot is round, and only the cell of its centre counts, where 253 is
    also a hit.
    """
    outline = np.ascontiguousarray(footprint, dtype=np.float64).reshape(-1, 2)
    costs = np.ascontiguousarray(grid.costs).reshape(-1)
    size = grid.width, grid.height
    found = compiled_footprint_cost()(costs, *size, *grid.origin, grid.resolution, *map(float, pose), outline, 1.0)
    return int(found)


def line_cells(x: int, y: int, end_x: int, end_y: int) -> list[tuple[int, int]]:
    """Return the cells (mx, my) on a line between two cells, including both, as the kernel visits them."""
    dx, dy = abs(end_x - x), abs(end_y - y)
    step_x, step_y = (1 if end_x >= x else -1), (1 if end_y >= y else -1)
    steps, gain, cells = max(dx, dy), min(dx, dy), []
    rest = steps // 2
    for _ in range(steps + 1):
        cells.append((x, y))
        rest += gain
        aside = rest >= steps
        rest -= steps * aside
        x += step_x if dx >= dy or aside else 0
        y += step_y if dx < dy or aside else 0
    return cells


def footprint_cells(grid: Costmap2D, pose: Pose, footprint: ArrayLike, *, fill: bool) -> list[tuple[int, int]]:
    """Return the cells (mx, my) under a footprint's outline at `pose`; with `fill`, also those inside it.

    The outline stops where it leaves the map, as in base_local_planner's `FootprintHelper`.
    """
    x, y, theta = pose
    cos, sin = np.cos(theta), np.sin(theta)
    vertices = [
        (x + px * cos - py * sin, y + px * sin + py * cos)
        for px, py in np.asarray(footprint, dtype=np.float64).reshape(-1, 2)
    ]
    if len(vertices) < 2:
        centre = grid.world_to_map(x, y)
        return [centre] if centre else []
    corners = [grid.world_to_map(*vertex) for vertex in vertices]
    cells: dict[tuple[int, int], None] = {}
    for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
        if start is None or end is None:
            return list(cells)
        cells.update(dict.fromkeys(line_cells(*start, *end)))
    if fill:
        columns: dict[int, list[int]] = {}
        for mx, my in cells:
            columns.setdefault(mx, []).append(my)
        for mx, rows in columns.items():
            cells.update(dict.fromkeys((mx, my) for my in range(min(rows), max(rows) + 1)))
    return list(cells)
