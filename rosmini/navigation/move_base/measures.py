"""How much room a robot has: measured on costmaps. Arrays in, numbers out."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.core.geometry.polygons import distances, inside
from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.navigation.costmap_2d import LETHAL_OBSTACLE, Costmap2D

Floats = NDArray[np.float64]


def obstacles(grid: Costmap2D, x: float, y: float, reach: float) -> Floats:
    """The middles (n, 2) [m] of the lethal cells within a square of half the side `reach` [m] around a point."""
    (x0, y0), (x1, y1) = (grid.world_to_map_clamped(x + s * reach, y + s * reach) for s in (-1, 1))
    rows, columns = np.nonzero(grid.costs[y0 : y1 + 1, x0 : x1 + 1] == LETHAL_OBSTACLE)
    cells = np.stack([columns + x0, rows + y0], axis=-1) + 0.5
    found: Floats = np.asarray(grid.origin) + cells * grid.resolution
    return found


def clearance(grid: Costmap2D, pose: Pose, footprint: ArrayLike, reach: float = 1.0) -> float | None:
    """The distance [m] from the outline of a footprint (n, 2) at `pose` to the middle of the nearest lethal cell.

    0 where such a cell is inside of it; None if there is none within `reach` [m] of the robot's centre.
    """
    points = obstacles(grid, pose[0], pose[1], reach)
    if not len(points) or len(np.asarray(footprint)) < 3:
        return None
    outline = transform_points(pose, footprint)
    sides = np.concatenate([outline, np.roll(outline, -1, axis=0)], axis=1)
    return 0.0 if inside(points, sides).any() else float(distances(points, sides).min())


def narrowest(grid: Costmap2D, path: Floats, reach: float = 1.0) -> tuple[float, float, float] | None:
    """Where a path (n, 2) [m] is nearest to a lethal cell: x, y [m], and the distance [m] to the cell's middle.

    None if the whole of it is farther than `reach` [m] from all of them.
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
    """The lethal cells that the layers with costs of their own hold together."""
    grids = [getattr(layer, "costs", None) for layer in layers]
    return sum(int((costs == LETHAL_OBSTACLE).sum()) for costs in grids if costs is not None)


def fewer(count: int) -> str:
    """The change of a number of lethal cells in words; a negative `count` means that there are more.

    >>> fewer(3), fewer(-2), fewer(0)
    ('3 lethal cells fewer', '2 lethal cells more', 'no lethal cell fewer')
    """
    if count == 0:
        return "no lethal cell fewer"
    return f"{abs(count)} lethal cells {'fewer' if count > 0 else 'more'}"
