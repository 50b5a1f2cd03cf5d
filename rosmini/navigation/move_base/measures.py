"""Distances between a robot and obstacles, measured on costmaps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.polygons import distances, inside
from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.navigation.costmap_2d import LETHAL_OBSTACLE, Costmap2D

Floats = NDArray[np.float64]


def obstacles(grid: Costmap2D, x: float, y: float, reach: float) -> Floats:
    """Return the centres (n, 2) [m] of the lethal cells in a square around a point with half the side `reach` [m]."""
    (x0, y0), (x1, y1) = (grid.world_to_map_clamped(x + s * reach, y + s * reach) for s in (-1, 1))
    rows, columns = np.nonzero(grid.costs[y0 : y1 + 1, x0 : x1 + 1] == LETHAL_OBSTACLE)
    cells = np.stack([columns + x0, rows + y0], axis=-1) + 0.5
    found: Floats = np.asarray(grid.origin) + cells * grid.resolution
    return found


def clearance(grid: Costmap2D, pose: Pose, footprint: ArrayLike, reach: float = 1.0) -> float | None:
    """Return the distance [m] from a footprint's outline (n, 2) at `pose` to the centre of the nearest lethal cell.

    The distance is 0 if such a cell is inside the outline. It is None if no such cell is within `reach` [m] of the
    robot's centre along both axes, or if the footprint has fewer than three vertices.
    """
    points = obstacles(grid, pose[0], pose[1], reach)
    if not len(points) or len(np.asarray(footprint)) < 3:
        return None
    outline = transform_points(pose, footprint)
    sides = np.concatenate([outline, np.roll(outline, -1, axis=0)], axis=1)
    return 0.0 if inside(points, sides).any() else float(distances(points, sides).min())


def narrowest(grid: Costmap2D, path: Floats, reach: float = 1.0) -> tuple[float, float, float] | None:
    """Return where a path (n, 2) [m] is closest to a lethal cell: x, y, and the distance to the cell's centre [m].

    Returns None if the whole path is farther than `reach` [m] from every lethal cell.
    """
    best: tuple[float, float, float] | None = None
    for x, y in path.tolist():
        points = obstacles(grid, x, y, reach if best is None else best[2])
        if len(points):
            away = float(np.hypot(points[:, 0] - x, points[:, 1] - y).min())
            if away < (reach if best is None else best[2]):
                best = (x, y, away)
    return best


def lethal_cells(layers: Sequence[object]) -> int:
    """Return the total number of lethal cells in all layers that store costs."""
    grids = [getattr(layer, "costs", None) for layer in layers]
    return sum(int((costs == LETHAL_OBSTACLE).sum()) for costs in grids if costs is not None)


def decrease_text(count: int) -> str:
    """Return a description of a decrease in the number of lethal cells; a negative `count` is an increase.

    >>> decrease_text(3), decrease_text(-2), decrease_text(0)
    ('3 lethal cells fewer', '2 lethal cells more', 'no lethal cell fewer')
    """
    if count == 0:
        return "no lethal cell fewer"
    return f"{abs(count)} lethal cells {'fewer' if count > 0 else 'more'}"
