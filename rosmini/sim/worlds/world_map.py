"""The map of a world: the grid cells in which a laser would see something."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import polygons
from rosmini.core.maps import GridMap
from rosmini.sim.geometry.slices import within
from rosmini.sim.shapes import ROUND, Simple, outline_at
from rosmini.sim.world import Pose, World, WorldError

MARGIN = 5
"""Number of cells that a map extends beyond the bounds of its world."""
MAX_CELLS = 100_000_000
"""Maximum number of cells."""

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def to_map(world: World, resolution: float = 0.05, *, height: float = 0.15) -> GridMap:
    """Return the map that a perfect mapper with a laser at `height` [m] would make, with cells of `resolution` [m].

    A cell is occupied if it overlaps a fixed object at that height, exactly where `World.blocked` reports one for a
    square of its size; free if it is connected to a start through free neighbours; otherwise unknown. Thin walls also
    occupy the cells they touch, so that none leaks; the insides of solid ones are occupied. Raises `WorldError` for a
    resolution that is not positive, or so fine that there would be more than 100 million cells.
    """
    if not (np.isfinite(resolution) and resolution > 0):
        raise WorldError(f"the resolution of a map is {resolution!r}; it must be a finite number above 0")
    x0, y0, x1, y1 = world.bounds
    left, low = (np.floor(edge / resolution) - MARGIN for edge in (x0, y0))
    columns, rows = (int(np.ceil(far / resolution) - near) + MARGIN for far, near in ((x1, left), (y1, low)))
    if columns * rows > MAX_CELLS:
        raise WorldError(
            f"a map of {world.name!r} with cells of {resolution:g} m has {columns} x {rows} cells, which is too many"
        )
    grid = _Grid(np.zeros((rows, columns), dtype=bool), resolution, (float(left) * resolution, float(low) * resolution))
    for obstacle in world.obstacles:
        if obstacle.fixed and obstacle.bottom <= height <= obstacle.height:
            for shape, pose in obstacle.parts():
                grid.fill(shape, pose)
    if height <= world.wall_height:
        grid.walls(world.walls, solid=world.solid)
    occupancy = np.full((rows, columns), -1, dtype=np.int8)
    occupancy[grid.reached(world.starts)] = 0
    occupancy[grid.taken] = 100
    occupancy.flags.writeable = False
    return GridMap(occupancy, resolution, (*grid.corner, 0.0))


class _Grid:
    """Cells of a grid, and which of them are occupied."""

    def __init__(self, taken: Bools, resolution: float, corner: tuple[float, float]) -> None:
        self.taken = taken
        self.resolution = resolution
        self.corner = corner

    def _window(self, low: Floats, high: Floats) -> tuple[slice, slice, Floats]:
        """Return the cells that a rectangle may touch, and their centres (n, 2)."""
        first = np.maximum(np.floor((low - self.corner) / self.resolution).astype(int) - 1, 0)
        last = np.minimum(np.ceil((high - self.corner) / self.resolution).astype(int) + 1, self.taken.shape[::-1])
        x = self.corner[0] + (np.arange(first[0], last[0]) + 0.5) * self.resolution
        y = self.corner[1] + (np.arange(first[1], last[1]) + 0.5) * self.resolution
        centres = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        return slice(first[1], last[1]), slice(first[0], last[0]), centres

    def _take(self, rows: slice, columns: slice, hit: Bools) -> None:
        block = self.taken[rows, columns]
        block |= hit.reshape(block.shape)

    @property
    def _half(self) -> float:
        """Half the side of a cell, minus the tolerance for touching."""
        return self.resolution / 2 - polygons.TOUCH

    def fill(self, shape: Simple, pose: Pose) -> None:
        """Mark the cells that a shape overlaps as occupied."""
        if isinstance(shape, ROUND):
            centre, r = np.array(pose[:2]), shape.radius
            rows, columns, cells = self._window(centre - r, centre + r)
            beside = np.maximum(np.abs(cells - centre) - self.resolution / 2, 0.0)
            self._take(rows, columns, np.hypot(*beside.T) < r - polygons.TOUCH)
            return
        outline = outline_at(shape, pose)
        sides = polygons.sides_of(outline)
        rows, columns, cells = self._window(outline.min(axis=0), outline.max(axis=0))
        self._take(rows, columns, polygons.inside(cells, sides) | within(cells, self._half, sides))

    def walls(self, walls: Floats, *, solid: bool) -> None:
        """Mark the cells that walls pass through, and those inside solid ones, as occupied."""
        half = self.resolution / 2 + (-polygons.TOUCH if solid else polygons.TOUCH)
        for wall in walls:
            ends = wall.reshape(2, 2)
            rows, columns, cells = self._window(ends.min(axis=0), ends.max(axis=0))
            self._take(rows, columns, within(cells, half, wall[None]))
        if solid and len(walls):
            rows, columns, cells = self._window(walls.reshape(-1, 2).min(axis=0), walls.reshape(-1, 2).max(axis=0))
            hit = np.concatenate(
                [polygons.inside(part, walls) for part in np.array_split(cells, len(cells) // 1000 + 1)]
            )
            self._take(rows, columns, hit)

    def reached(self, starts: tuple[Pose, ...]) -> Bools:
        """Return the cells that are connected to a start."""
        rows, columns = self.taken.shape
        open_ = np.pad(~self.taken, 1)
        width = columns + 2
        left = bytearray(open_.astype(np.uint8).tobytes())
        places = ((np.array([start[:2] for start in starts]) - self.corner) / self.resolution).astype(int)
        todo = deque(
            (row + 1) * width + column + 1
            for column, row in places.tolist()
            if 0 <= row < rows and 0 <= column < columns
        )
        found = bytearray(len(left))
        for cell in todo:
            found[cell] = left[cell]
        while todo:
            cell = todo.popleft()
            if not found[cell]:
                continue
            for beside in (cell - 1, cell + 1, cell - width, cell + width):
                if left[beside] and not found[beside]:
                    found[beside] = 1
                    todo.append(beside)
        every: Bools = np.frombuffer(found, dtype=bool).reshape(rows + 2, width)[1:-1, 1:-1]
        return every
