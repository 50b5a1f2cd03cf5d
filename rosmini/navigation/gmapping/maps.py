"""The maps of all particles, divided into patches; equal patches are shared, and copied when one changes.

A cell counts the beams that ended in it and those that passed or ended, and stores the mean of the ends: GMapping's
point accumulator. Its occupancy is the ratio of the two counts, or -1 without any beam.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.navigation.kernels import kernel

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

SIDE = 32
"""Number of cells along the side of a patch."""
FULL_FRACTION = 0.1
"""A cell is full if more than this fraction of its visits were beam ends."""
MAX_PATCHES = 1 << 20
"""Maximum number of patches in a map: 1.6 km x 1.6 km with cells of 5 cm."""
EMPTY_PATCH = 0
"""Index in a table of the empty patch, for areas without any beam."""

PATCH_BYTES = SIDE * (SIDE * (4 + 4 + 16) + 8)
"""Memory of a patch [bytes]: hits, visits, mean ends, and bits of full cells."""


class Pool(NamedTuple):
    """The arrays of `SharedMaps`, for the compiled loops."""

    tables: Any
    hits: Any
    visits: Any
    means: Any
    full: Any
    owners: Any
    low_x: int
    low_y: int
    resolution: float


class Scan(NamedTuple):
    """A scan to be written into the maps."""

    ranges: Any
    bearings: Any
    usable: float
    touched: Any
    """Patches (rows, columns): workspace to mark those that beams cross."""


class SharedMaps:
    """The maps of `count` particles, with cells of `resolution` [m].

    Cell (0, 0) of a table's first patch is at `low` (column, row) on a lattice whose corner is the world's origin, so
    maps can grow on all sides without moving a cell.
    """

    def __init__(self, count: int, resolution: float) -> None:
        self.resolution = resolution
        self.low = (0, 0)
        self.tables: Ints = np.full((count, 0, 0), EMPTY_PATCH, dtype=np.int32)
        """Indices of patches in the pool (particles, rows, columns)."""
        self.hits: Ints = np.zeros((1, SIDE, SIDE), dtype=np.int32)
        """Number of beams that ended in each cell (patches, rows, columns)."""
        self.visits: Ints = np.zeros((1, SIDE, SIDE), dtype=np.int32)
        """Number of beams that passed or ended in each cell."""
        self.means: Floats = np.zeros((1, SIDE, SIDE, 2))
        """Mean of the beam ends in each cell [m]."""
        self.full: NDArray[np.int64] = np.zeros((1, SIDE), dtype=np.int64)
        """Bits of full cells (patches, rows), one per column: 1 if the share of ends exceeds `FULL_FRACTION`.

        A matcher reads these bits, and those of a patch are adjacent in memory."""
        self.owners: NDArray[np.int64] = np.zeros(1, dtype=np.int64)
        """Number of maps that share each patch (patches,); 0 for the empty patch and unused ones."""

    # -- memory --------------------------------------------------------------------------------------------------

    def cover(self, left: float, bottom: float, right: float, top: float) -> None:
        """Extend all maps to cover this box [m] and one patch more, so that every cell inside has neighbours.

        Raises `RosminiError` for an invalid box and for maps that would be too large; the maps are then unchanged.
        """
        block = SIDE * self.resolution
        if not np.isfinite((left, bottom, right, top)).all():
            raise RosminiError(f"a scan seen from ({left}, {bottom}) to ({right}, {top}) m has no position on a map")
        x0, y0 = int(np.floor(left / block)) - 1, int(np.floor(bottom / block)) - 1
        x1, y1 = int(np.floor(right / block)) + 2, int(np.floor(top / block)) + 2
        _, rows, columns = self.tables.shape
        here_x, here_y = self.low[0] // SIDE, self.low[1] // SIDE
        if not rows:
            here_x, here_y = x0, y0
        west, south = max(0, here_x - x0), max(0, here_y - y0)
        east, north = max(0, x1 - here_x - columns), max(0, y1 - here_y - rows)
        if (rows + south + north) * (columns + west + east) > MAX_PATCHES:
            raise RosminiError(
                f"the maps would have to extend from ({left:.4g}, {bottom:.4g}) to ({right:.4g}, {top:.4g}) m: with "
                f"cells of {self.resolution} m more than {MAX_PATCHES * SIDE * SIDE:.1g} of them; check "
                "for jumps of the odometry, or a maxUrange that is too long"
            )
        if west or south or east or north or not rows:
            self.tables = np.pad(self.tables, ((0, 0), (south, north), (west, east)), constant_values=EMPTY_PATCH)
            self.low = ((here_x - west) * SIDE, (here_y - south) * SIDE)

    def _add_patches(self, count: int) -> None:
        """Add at least `count` patches."""
        more = max(count, len(self.hits) // 2, 64)
        grow = ((0, more), (0, 0), (0, 0))
        self.hits, self.visits = np.pad(self.hits, grow), np.pad(self.visits, grow)
        self.means, self.full = np.pad(self.means, (*grow, (0, 0))), np.pad(self.full, grow[:2])
        self.owners = np.pad(self.owners, grow[0])

    @property
    def bytes_used(self) -> int:
        """The memory of all patches that belong to a map [bytes]."""
        return int((self.owners > 0).sum()) * PATCH_BYTES

    # -- changes -------------------------------------------------------------------------------------------------

    def choose(self, indices: NDArray[np.int64]) -> None:
        """Replace the maps by those of the particles `indices` (n,); duplicates are not copied until they change."""
        self.tables = np.ascontiguousarray(self.tables[indices])
        self.owners = np.bincount(self.tables[self.tables != EMPTY_PATCH], minlength=len(self.hits)).astype(np.int64)

    def register(self, laser_poses: Floats, ranges: Floats, bearings: Floats, usable: float) -> None:
        """Write a scan into each map, from that particle's laser pose (n, 3).

        `ranges` (b,) [m] must not contain 0, values above the laser's maximum, or infinite values; ranges of at least
        `usable` [m] clear the cells up to there, without an end.
        """
        if not len(ranges):
            return
        reach = min(float(ranges.max()), usable) + self.resolution
        x, y = laser_poses[:, 0], laser_poses[:, 1]
        self.cover(x.min() - reach, y.min() - reach, x.max() + reach, y.max() + reach)
        scan = Scan(ranges, bearings, usable, np.zeros(self.tables.shape[1:], dtype=np.uint8))
        done = 0
        while done < len(laser_poses):
            free = np.flatnonzero(self.owners[1:] == 0).astype(np.int64) + 1
            done = compiled_register()(self.pool, scan, laser_poses, free, done)
            if done < len(laser_poses):
                self._add_patches(int(scan.touched.sum()))

    @property
    def pool(self) -> Pool:
        """The current arrays."""
        grids = self.hits, self.visits, self.means, self.full
        return Pool(self.tables, *grids, self.owners, *self.low, self.resolution)

    # -- the map -------------------------------------------------------------------------------------------------

    def occupancy(self, particle: int) -> tuple[Floats, tuple[float, float]]:
        """Return the occupancy (h, w) of a particle's map, 0 to 1, or -1 if unknown, and its lower left corner [m]."""
        table = self.tables[particle]
        rows, columns = table.shape
        found = np.full((rows * SIDE, columns * SIDE), -1.0)
        for row, column in np.argwhere(table != EMPTY_PATCH).tolist():
            patch = table[row, column]
            visits = self.visits[patch]
            cells = np.where(visits > 0, self.hits[patch] / np.maximum(visits, 1), -1.0)
            found[row * SIDE : (row + 1) * SIDE, column * SIDE : (column + 1) * SIDE] = cells
        return found, (self.low[0] * self.resolution, self.low[1] * self.resolution)


def trace(n: int, pose: Any, pool: Any, scan: Any, write: bool) -> None:
    """Follow each beam from cell to cell (Bresenham); mark the patches on the way, or write into their cells."""
    per_metre, low_x, low_y = 1.0 / pool.resolution, pool.low_x, pool.low_y
    x, y, heading, usable = pose[0], pose[1], pose[2], scan.usable
    from_x, from_y = math.floor(x * per_metre) - low_x, math.floor(y * per_metre) - low_y
    for b in range(len(scan.ranges)):
        reach = min(scan.ranges[b], usable)
        end_x = x + reach * math.cos(heading + scan.bearings[b])
        end_y = y + reach * math.sin(heading + scan.bearings[b])
        to_x, to_y = math.floor(end_x * per_metre) - low_x, math.floor(end_y * per_metre) - low_y
        dx, dy = abs(to_x - from_x), abs(to_y - from_y)
        step_x, step_y = (1 if to_x > from_x else -1), (1 if to_y > from_y else -1)
        column, row, error, last = from_x, from_y, dx - dy, False
        while not last:
            last = column == to_x and row == to_y
            if not write:
                scan.touched[row >> 5, column >> 5] = 1
            elif not last or scan.ranges[b] < usable:
                count(pool.tables[n, row >> 5, column >> 5], row & 31, column & 31, last, end_x, end_y, pool)
            twice = 2 * error
            if twice > -dy:
                error -= dy
                column += step_x
            if twice < dx:
                error += dx
                row += step_y


def count(patch: int, i: int, j: int, is_end: bool, x: float, y: float, pool: Any) -> None:
    """Update a cell for a beam that passes it, or ends in it at (x, y) [m]."""
    pool.visits[patch, i, j] += 1
    if is_end:
        pool.hits[patch, i, j] += 1
        share = 1.0 / pool.hits[patch, i, j]
        pool.means[patch, i, j, 0] += share * (x - pool.means[patch, i, j, 0])
        pool.means[patch, i, j, 1] += share * (y - pool.means[patch, i, j, 1])
    ends = pool.hits[patch, i, j]
    if ends:
        is_full = ends > FULL_FRACTION * pool.visits[patch, i, j]
        if ((pool.full[patch, i] >> j) & 1 == 1) != is_full:
            pool.full[patch, i] ^= 1 << j


def copy_patch(n: int, row: int, column: int, patch: int, pool: Any) -> None:
    """Copy a shared patch of particle `n`'s map into the free patch `patch`, which replaces it."""
    old = pool.tables[n, row, column]
    for i in range(32):
        pool.full[patch, i] = pool.full[old, i]
        for j in range(32):
            pool.hits[patch, i, j] = pool.hits[old, i, j]
            pool.visits[patch, i, j] = pool.visits[old, i, j]
            pool.means[patch, i, j, 0] = pool.means[old, i, j, 0]
            pool.means[patch, i, j, 1] = pool.means[old, i, j, 1]
    if old:
        pool.owners[old] -= 1
    pool.owners[patch] = 1
    pool.tables[n, row, column] = patch


def register(pool: Any, scan: Any, poses: Any, free: Any, first: int) -> int:
    """Write a scan into the maps from index `first` on, using the patches `free` for copies.

    Returns the index of the first map for which they are not enough, or the number of maps.
    """
    taken = 0
    for n in range(first, len(poses)):
        for row in range(scan.touched.shape[0]):
            for column in range(scan.touched.shape[1]):
                scan.touched[row, column] = 0
        pose = poses[n, 0], poses[n, 1], poses[n, 2]
        trace(n, pose, pool, scan, False)
        for row in range(scan.touched.shape[0]):
            for column in range(scan.touched.shape[1]):
                if scan.touched[row, column] and pool.owners[pool.tables[n, row, column]] != 1:
                    if taken == len(free):
                        return n
                    copy_patch(n, row, column, free[taken], pool)
                    taken += 1
        trace(n, pose, pool, scan, True)
    return len(poses)


@kernel(register, count, trace, copy_patch)
def compiled_register(numba: Any) -> Any:
    """Return `register`, compiled if numba is available; the body returns its signature for the decorator."""
    record = numba.types.NamedTuple
    cells, beams = numba.int32[:, :, ::1], numba.float64[::1]
    grids = cells, cells, cells, numba.float64[:, :, :, ::1], numba.int64[:, ::1], numba.int64[::1]
    pool = record((*grids, numba.int64, numba.int64, numba.float64), Pool)
    scan = record((beams, beams, numba.float64, numba.uint8[:, ::1]), Scan)
    return numba.int64(pool, scan, numba.float64[:, ::1], numba.int64[::1], numba.int64)
