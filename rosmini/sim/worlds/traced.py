"""Worlds with walls traced from a ROS map, as in Stage's floor plans from an image."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rosmini.core.geometry.errors import GeometryError
from rosmini.core.geometry.poses import inverse, transform_points
from rosmini.core.maps import GridMap, load_map
from rosmini.sim.geometry.contours import trace
from rosmini.sim.world import Pose, World, WorldError

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROOM = 0.25
"""Required free space around a start, to each side [m]."""
ENOUGH = 1.0
"""Free space beyond which a place is not considered better [m]."""


def world_from_map(
    yaml_path: str | os.PathLike[str], *, title: str = "", starts: tuple[Pose, ...] | None = None
) -> World:
    """Return the world of a map: its walls are the outlines of the occupied cells, in the frame of the map.

    Unknown cells count as free. Without `starts` a robot starts at the origin of the map's frame, usually the start of
    the robot that made the map, or in the largest free space if the origin is not free. Raises `load_map`'s errors, and
    `WorldError` for too many outlines.
    """
    grid = load_map(yaml_path)
    try:
        walls = trace(grid.occupied, grid.resolution, grid.origin)
    except GeometryError as error:
        raise WorldError(f"{yaml_path}: {error}") from error
    return World(
        Path(yaml_path).stem,
        walls=walls,
        starts=starts or (_start(grid),),
        title=title or f"The map {Path(yaml_path).name}",
        solid=True,
    )


def _start(grid: GridMap) -> Pose:
    column, row = transform_points(inverse(grid.origin), [(0.0, 0.0)])[0] / grid.resolution
    reach = ROOM / grid.resolution
    height, width = grid.free.shape
    if reach <= column <= width - reach and reach <= row <= height - reach:
        around = grid.free[
            int(row - reach) : int(np.ceil(row + reach)), int(column - reach) : int(np.ceil(column + reach))
        ]
        if around.all():
            return (0.0, 0.0, 0.0)
    rows, columns = np.nonzero(_roomiest(grid.free, int(np.ceil(ENOUGH / grid.resolution))))
    if not len(rows):
        return (0.0, 0.0, 0.0)
    nearest = np.argmin(np.hypot(columns + 0.5 - column, rows + 0.5 - row))
    cell = np.array([(columns[nearest] + 0.5, rows[nearest] + 0.5)]) * grid.resolution
    x, y = transform_points(grid.origin, cell)[0]
    return (float(x), float(y), 0.0)


def _roomiest(free: NDArray[np.bool_], most: int) -> NDArray[np.bool_]:
    """Return the free cells farthest from all others, in steps to the sides; at most `most` steps are considered."""
    left = free
    for _ in range(most):
        padded = np.pad(left, 1)
        inner = left & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        if not inner.any():
            break
        left = inner
    return left
