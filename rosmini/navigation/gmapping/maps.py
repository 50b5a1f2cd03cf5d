"""The maps of all particles: cut into patches, of which equal ones are held once, and copied when one changes.

A cell counts how often beams ended in it and how often they passed or ended, and has the mean of the ends: GMapping's
point accumulator. Its occupancy is the quotient of the two counts, -1 if no beam ever came.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.machine_code import machine_code
from rosmini.navigation.kernels import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

SIDE = 32
"""Cells along the side of a patch."""
FULL = 0.1
"""A cell is full if more than this share of its visits were ends."""
NONE = -1
"""In a table: a patch where no beam ever came."""

REGISTER = f"{__name__}:compiled_register"


class SharedMaps:
    """The maps of `count` particles, of cells of `resolution` [m].

    Cell (0, 0) of a table's first patch is at `low` (column, row) of a lattice whose corner is the origin of the world,
    so that maps may grow to all sides without a cell that moves.
    """

    def __init__(self, count: int, resolution: float) -> None:
        self.resolution = resolution
        self.low = (0, 0)
        self.tables: Ints = np.full((count, 0, 0), NONE, dtype=np.int32)
        """(particles, rows, columns) of patches: the number of each in the pool."""
        self.hits: Ints = np.zeros((0, SIDE, SIDE), dtype=np.int32)
        """(patches, rows, columns): how often a beam ended in the cell."""
        self.visits: Ints = np.zeros((0, SIDE, SIDE), dtype=np.int32)
        """How often a beam passed it or ended in it."""
        self.means: Floats = np.zeros((0, SIDE, SIDE, 2))
        """The mean of the ends [m]."""
        self.full: NDArray[np.uint8] = np.zeros((0, SIDE, SIDE), dtype=np.uint8)
        """1 where ends are at least the share `FULL` of the visits: what a matcher looks for."""
        self._free: list[int] = []

    # -- room ----------------------------------------------------------------------------------------------------

    def cover(self, left: float, bottom: float, right: float, top: float) -> None:
        """Let all maps reach over this box [m]."""
        block = SIDE * self.resolution
        x0, y0 = int(np.floor(left / block)), int(np.floor(bottom / block))
        x1, y1 = int(np.floor(right / block)) + 1, int(np.floor(top / block)) + 1
        _, rows, columns = self.tables.shape
        here_x, here_y = self.low[0] // SIDE, self.low[1] // SIDE
        if not rows:
            here_x, here_y = x0, y0
        west, south = max(0, here_x - x0), max(0, here_y - y0)
        east, north = max(0, x1 - here_x - columns), max(0, y1 - here_y - rows)
        if west or south or east or north or not rows:
            self.tables = np.pad(self.tables, ((0, 0), (south, north), (west, east)), constant_values=NONE)
            self.low = ((here_x - west) * SIDE, (here_y - south) * SIDE)

    def _take(self, count: int) -> list[int]:
        """Numbers of patches that nobody has, of which the pool gets more if need be."""
        if len(self._free) < count:
            have = len(self.hits)
            more = max(count - len(self._free), have // 2, 64)
            grow = ((0, more), (0, 0), (0, 0))
            self.hits, self.visits = np.pad(self.hits, grow), np.pad(self.visits, grow)
            self.means, self.full = np.pad(self.means, (*grow, (0, 0))), np.pad(self.full, grow)
            self._free += range(have + more - 1, have - 1, -1)
        return [self._free.pop() for _ in range(count)]

    @property
    def owners(self) -> NDArray[np.int64]:
        """How many maps each patch of the pool belongs to."""
        used = self.tables[self.tables != NONE]
        return np.bincount(used.ravel(), minlength=len(self.hits))

    @property
    def bytes_used(self) -> int:
        """The memory of all patches that belong to a map."""
        return int((self.owners > 0).sum()) * SIDE * SIDE * (4 + 4 + 16)

    # -- change --------------------------------------------------------------------------------------------------

    def choose(self, indices: NDArray[np.int64]) -> None:
        """Go on with the maps of these particles; one that is chosen twice is not copied until it changes."""
        self.tables = self.tables[indices]
        owners = self.owners
        free = set(self._free)
        dropped = [int(patch) for patch in np.flatnonzero(owners == 0) if int(patch) not in free]
        self.hits[dropped] = 0
        self.visits[dropped] = 0
        self.means[dropped] = 0.0
        self.full[dropped] = 0
        self._free += dropped[::-1]

    def register(self, laser_poses: Floats, ranges: Floats, bearings: Floats, usable: float) -> None:
        """Write a scan into each map, seen from that particle's laser pose (n, 3).

        `ranges` (b,) [m] that are 0, above the laser's maximum or not finite are left out before; those of `usable` [m]
        and above clear the way so far, and end nowhere.
        """
        if not len(ranges):
            return
        reach = min(float(ranges.max()), usable) + self.resolution
        x, y = laser_poses[:, 0], laser_poses[:, 1]
        self.cover(x.min() - reach, y.min() - reach, x.max() + reach, y.max() + reach)
        owners = self.owners
        write = kernel(REGISTER)
        touched = np.zeros(self.tables.shape[1:], dtype=np.uint8)
        for table, pose in zip(self.tables, laser_poses, strict=True):
            common = (
                self.low[0],
                self.low[1],
                self.resolution,
                *pose.tolist(),
                ranges,
                bearings,
                usable,
                touched,
            )
            touched[:] = 0
            write(table, self.hits, self.visits, self.means, self.full, *common, False)
            self._own(table, touched.astype(bool), owners)
            if len(owners) < len(self.hits):
                owners = np.pad(owners, (0, len(self.hits) - len(owners)))
            write(table, self.hits, self.visits, self.means, self.full, *common, True)

    def _own(self, table: Ints, touched: NDArray[np.bool_], owners: NDArray[np.int64]) -> None:
        """See to it that the patches that are touched belong to this map alone."""
        empty = np.argwhere(touched & (table == NONE))
        for (row, column), patch in zip(empty.tolist(), self._take(len(empty)), strict=True):
            table[row, column] = patch
        shared = np.argwhere(touched & (table != NONE))
        for row, column in shared.tolist():
            patch = int(table[row, column])
            if patch < len(owners) and owners[patch] > 1:
                owners[patch] -= 1
                (own,) = self._take(1)
                for array in (self.hits, self.visits, self.means, self.full):
                    array[own] = array[patch]
                table[row, column] = own

    # -- the map -------------------------------------------------------------------------------------------------

    def occupancy(self, particle: int) -> tuple[Floats, tuple[float, float]]:
        """The occupancy (h, w) of one map, -1 where unknown, and the lower left corner of cell (0, 0) [m]."""
        table = self.tables[particle]
        rows, columns = table.shape
        found = np.full((rows * SIDE, columns * SIDE), -1.0)
        for row, column in np.argwhere(table != NONE).tolist():
            patch = table[row, column]
            visits = self.visits[patch]
            cells = np.where(visits > 0, self.hits[patch] / np.maximum(visits, 1), -1.0)
            found[row * SIDE : (row + 1) * SIDE, column * SIDE : (column + 1) * SIDE] = cells
        return found, (self.low[0] * self.resolution, self.low[1] * self.resolution)


def register(
    table: Any,
    hits: Any,
    visits: Any,
    means: Any,
    full: Any,
    low_x: int,
    low_y: int,
    resolution: float,
    x: float,
    y: float,
    heading: float,
    ranges: Any,
    bearings: Any,
    usable: float,
    touched: Any,
    write: bool,
) -> None:
    """Go along each beam from cell to cell (Bresenham); mark the patches on the way, or write into their cells."""
    per_metre = 1.0 / resolution
    from_x, from_y = math.floor(x * per_metre) - low_x, math.floor(y * per_metre) - low_y
    for b in range(len(ranges)):
        reach = min(ranges[b], usable)
        end_x = x + reach * math.cos(heading + bearings[b])
        end_y = y + reach * math.sin(heading + bearings[b])
        to_x, to_y = math.floor(end_x * per_metre) - low_x, math.floor(end_y * per_metre) - low_y
        dx, dy = abs(to_x - from_x), abs(to_y - from_y)
        step_x, step_y = (1 if to_x > from_x else -1), (1 if to_y > from_y else -1)
        column, row, error = from_x, from_y, dx - dy
        while True:
            last = column == to_x and row == to_y
            i, j = row >> 5, column >> 5
            if not write:
                touched[i, j] = 1
            elif not last or ranges[b] < usable:
                patch = table[i, j]
                visits[patch, row & 31, column & 31] += 1
                if last:
                    hits[patch, row & 31, column & 31] += 1
                    share = 1.0 / hits[patch, row & 31, column & 31]
                    mean_x, mean_y = (
                        means[patch, row & 31, column & 31, 0],
                        means[patch, row & 31, column & 31, 1],
                    )
                    means[patch, row & 31, column & 31, 0] = mean_x + share * (end_x - mean_x)
                    means[patch, row & 31, column & 31, 1] = mean_y + share * (end_y - mean_y)
                share = hits[patch, row & 31, column & 31] / visits[patch, row & 31, column & 31]
                full[patch, row & 31, column & 31] = 1 if share > FULL else 0
            if last:
                break
            twice = 2 * error
            if twice > -dy:
                error -= dy
                column += step_x
            if twice < dx:
                error += dx
                row += step_y


@cache
def compiled_register() -> Callable[..., None]:
    """`register` as machine code, or as it is without numba."""
    try:
        from numba import boolean, float64, int32, int64, uint8, void
    except ImportError:
        return register
    number, beams = float64, float64[::1]
    grids = int32[:, :, ::1], int32[:, :, ::1], float64[:, :, :, ::1], uint8[:, :, ::1]
    place = int64, int64, number, number, number, number
    signature = void(int32[:, ::1], *grids, *place, beams, beams, number, uint8[:, ::1], boolean)
    return machine_code(register, signature)
