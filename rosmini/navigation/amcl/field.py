"""The likelihood of laser beams at each position: the likelihood field, and the ranges that the beam model expects.

Thrun, Burgard and Fox, Probabilistic Robotics (2005), sections 6.3 and 6.4. A field contains for each cell the value
that a beam which ends there adds to a particle's score, so scoring is a lookup. As in the original
(http://wiki.ros.org/amcl), the cubes of the likelihoods are added, instead of multiplying likelihoods, because
neighbouring beams are not independent.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Table = NDArray[np.float32]
Form = Literal["cube", "log"]

BORDER_STEP = 1e-4
"""A beam steps this distance [cells] past the border of a cell, so that rounding does not keep it in the cell."""
RANGE_ROUNDING = 2e-6
"""Additional step past the border, as a fraction of the maximum range: a few rounding errors of `float32`."""
MIN_DIRECTION = 1e-7
"""Minimum absolute value of a beam's direction along each axis, which avoids dividing by zero."""
CORNER_DISTANCE = 1.4143
"""Half a cell diagonal in the beam's cell plus half of one in the nearest blocked cell [cells]."""
REMOVAL_FRACTION = 0.4
"""Fraction of finished beams at which they are removed from the arrays; removing costs as much as a step."""
REMOVAL_STEPS = 8
"""Number of steps after which finished beams are removed in any case."""


@dataclass(frozen=True)
class BeamMixture:
    """Mixture weights of the causes of a measured range, see http://wiki.ros.org/amcl#Laser_model_parameters."""

    z_hit: float = 0.95
    z_short: float = 0.1
    z_max: float = 0.05
    z_rand: float = 0.05
    sigma_hit: float = 0.2
    """Standard deviation of a beam that hits an obstacle in the map [m]."""
    lambda_short: float = 0.1
    """Decay rate of beams that end too early [1/m]."""


class LikelihoodField:
    """A map with the likelihood of beams that end in each cell.

    Args:
        occupied: (h, w), row 0 at the bottom: the occupied cells.
        resolution: the side of a cell [m].
        origin: x and y of the lower left corner of cell (0, 0) [m].
        farthest: upper bound of the distances to occupied cells [m].
        free: (h, w): the cells that a beam passes; by default all that are not occupied. As in the original, beams of
            the beam model also end in unknown cells.

    """

    def __init__(
        self,
        occupied: Bools,
        resolution: float,
        origin: tuple[float, float],
        farthest: float = 2.0,
        free: Bools | None = None,
    ) -> None:
        self.occupied = np.ascontiguousarray(occupied)
        self.blocked = self.occupied if free is None else ~np.ascontiguousarray(free)
        self.resolution, self.origin, self.farthest = float(resolution), origin, float(farthest)
        cells = max(1, round(farthest / resolution))
        self.distance: Table = np.minimum(distances(self.occupied, cells) * resolution, farthest).astype(np.float32)
        """Distances (h, w) to the nearest occupied cell [m]."""
        self._table: tuple[tuple[BeamMixture, float, Form], Table, float] | None = None
        """The table used last, kept for further beams of the same laser."""
        self._clear: Table | None = None
        """The clearances for `cast_beams`; computed when the beam model first needs them."""

    def densities(self, mixture: BeamMixture, range_max: float, form: Form) -> tuple[Table, float]:
        """Return a table (h, w) for beams that end in each cell, and the value for beams that end outside the map.

        The values are probability densities, cubed or as logarithms by `form`; `range_max` is the laser's [m].
        """
        key = (mixture, range_max, form)
        if self._table is None or self._table[0] != key:
            # Squared distances are whole numbers of squared cells, so the few possible values can be tabulated.
            steps = np.rint((self.distance / self.resolution) ** 2).astype(np.int32)
            values = np.arange(int(steps.max()) + 1) * self.resolution**2
            values = np.append(np.minimum(values, self.farthest**2), self.farthest**2)
            density = mixture.z_hit * np.exp(-values / (2 * mixture.sigma_hit**2)) + mixture.z_rand / range_max
            formed = (density * density * density if form == "cube" else np.log(density)).astype(np.float32)
            self._table = key, formed[steps], float(formed[-1])
        _, table, outside = self._table
        return table, outside

    def sums(self, table: Table, outside: float, poses: Floats, ends: Floats) -> Floats:
        """Return for each pose (n, 3) the sum over all beams of the `table` values at their ends.

        `ends` (b, 2) are the beam ends in the frame of the poses [m].
        """
        sums: Floats = np.empty(len(poses))
        compiled_scores()(
            table,
            outside,
            *self.origin,
            1.0 / self.resolution,
            np.ascontiguousarray(poses),
            np.ascontiguousarray(ends),
            sums,
        )
        return sums

    def each(self, table: Table, outside: float, poses: Floats, ends: Floats) -> Floats:
        """Return the `table` values at the beam ends for each pose and beam (n, b); `outside` for ends outside the map.

        Arguments are those of `sums`.
        """
        cos, sin = np.cos(poses[:, 2])[:, None], np.sin(poses[:, 2])[:, None]
        x = poses[:, 0, None] + cos * ends[:, 0] - sin * ends[:, 1]
        y = poses[:, 1, None] + sin * ends[:, 0] + cos * ends[:, 1]
        column = np.floor((x - self.origin[0]) / self.resolution).astype(np.int64)
        row = np.floor((y - self.origin[1]) / self.resolution).astype(np.int64)
        height, width = table.shape
        inside = (row >= 0) & (row < height) & (column >= 0) & (column < width)
        found: Floats = np.full(inside.shape, outside)
        found[inside] = table[row[inside], column[inside]]
        return found

    def ranges(self, poses: Floats, bearings: Floats, range_max: float) -> Floats:
        """Return the range (n, b) [m] of a beam from each pose at each bearing [rad], at most `range_max`."""
        if self._clear is None:
            cells = max(1, round(self.farthest / self.resolution))
            self._clear = clearances(self.blocked, cells)
        origin, cells_per_metre = np.array((*self.origin, 0.0)), 1.0 / self.resolution
        starts = (poses - origin) * (cells_per_metre, cells_per_metre, 1.0)
        return cast_beams(self._clear, starts, bearings, range_max * cells_per_metre) * self.resolution


def scores(
    table: Any, outside: float, left: float, low: float, per_metre: float, poses: Any, ends: Any, sums: Any
) -> None:
    """Write into `sums` (n,) what `LikelihoodField.sums` returns, computed with scalar loops."""
    height, width = table.shape
    for n in range(poses.shape[0]):
        cos, sin = math.cos(poses[n, 2]), math.sin(poses[n, 2])
        x, y = (poses[n, 0] - left) * per_metre, (poses[n, 1] - low) * per_metre
        total = 0.0
        for b in range(ends.shape[0]):
            u = x + (cos * ends[b, 0] - sin * ends[b, 1]) * per_metre
            v = y + (sin * ends[b, 0] + cos * ends[b, 1]) * per_metre
            if 0.0 <= u < width and 0.0 <= v < height:
                total += table[int(v), int(u)]
            else:
                total += outside
        sums[n] = total


@kernel(scores)
def compiled_scores(numba: Any) -> Any:
    """Return `scores`, compiled if numba is available; the body returns its signature for the decorator."""
    number, table = numba.float64, numba.float64[:, ::1]
    return numba.void(numba.float32[:, ::1], number, number, number, number, table, table, numba.float64[::1])


def distances(occupied: Bools, farthest: int) -> NDArray[np.float32]:
    """Return the exact distance of each cell (h, w) from the centre of the nearest occupied cell [cells].

    Distances above `farthest` [cells] are replaced by it. A squared distance is the minimum, over the cells of the
    column, of the squared distance along the row plus that along the column.
    """
    height, width = occupied.shape
    limit = farthest + 1
    # Use a narrow integer type if the largest sum of two squares fits: on a large map memory traffic takes the time.
    small = np.uint16 if 2 * limit * limit < 1 << 16 else np.int32
    row = np.full((height, width), limit, dtype=small)
    row[occupied] = 0
    for column in range(1, width):
        np.minimum(row[:, column], row[:, column - 1] + 1, out=row[:, column])
    for column in range(width - 2, -1, -1):
        np.minimum(row[:, column], row[:, column + 1] + 1, out=row[:, column])
    squares = np.minimum(row, limit) ** 2
    best = squares.copy()
    for step in range(1, min(farthest, height - 1) + 1):
        more = step * step
        np.minimum(best[step:], squares[:-step] + more, out=best[step:])
        np.minimum(best[:-step], squares[step:] + more, out=best[:-step])
    found: NDArray[np.float32] = np.sqrt(np.minimum(best, farthest * farthest), dtype=np.float32)
    return found


def clearances(blocked: Bools, farthest: int) -> Table:
    """Return the distance that a beam can travel from any point in a cell without a hit [cells]; -1 in blocked cells.

    The map (h, w) gets a blocked border, so the result has the shape (h + 2, w + 2).
    """
    walled = np.pad(blocked, 1, constant_values=True)
    free = np.maximum(distances(walled, farthest) - CORNER_DISTANCE, 0.0)
    return np.where(walled, -1.0, free).astype(np.float32)


def cast_beams(clear: Table, poses: Floats, bearings: Floats, limit: float) -> Floats:
    """Return the ranges (n, b) [cells] of beams from poses (n, 3) [cells, cells, rad] at bearings [rad], up to `limit`.

    All beams step at once: by the distance that is certainly free, or else to the border of the cell (sphere tracing,
    Hart 1996, on a grid). The result is exact except where a beam cuts a corner by less than `BORDER_STEP`.
    """
    width, beams = clear.shape[1], len(bearings)
    rays, base = rays_from(clear.shape, poses, bearings, BORDER_STEP + RANGE_ROUNDING * limit)
    longest, table = np.float32(limit), clear.ravel()
    travelled, index = np.zeros(len(base), dtype=np.float32), np.arange(len(base))
    found, rounds = np.full(len(base), longest), 0
    while len(index):
        at = rays[:2] * travelled
        at += rays[2:4]
        cell = np.floor(at)
        column, row = cell.astype(np.int32)
        free = table.take(base + row * width + column)
        at -= cell
        np.subtract(rays[4:6], at, out=at)
        at *= rays[6:]
        step = np.minimum(at[0], at[1])
        np.maximum(step, free, out=step)
        done = (free < 0) | (travelled >= longest)
        step[done] = 0
        travelled += step
        rounds += 1
        if rounds % REMOVAL_STEPS == 0 or np.count_nonzero(done) > REMOVAL_FRACTION * len(done):
            found[index[done]] = travelled[done]
            kept = np.flatnonzero(~done)
            index, base, travelled, rays = index[kept], base[kept], travelled[kept], rays.take(kept, axis=1)
    return np.minimum(found, longest).astype(np.float64).reshape(len(poses), beams)


def rays_from(shape: tuple[int, ...], poses: Floats, bearings: Floats, nudge: float) -> tuple[Table, NDArray[np.int32]]:
    """Return the values that `cast_beams` needs for each beam (8, n b), and the index (n b,) of its first cell.

    The rows are pairs of x and y: direction; start within the cell; coordinate at which a beam leaves a cell, which is
    `nudge` past the border; reciprocal of the direction.
    """
    height, width = shape
    low = np.floor(poses[:, :2])
    rows, columns = low[:, 1] + 1, low[:, 0] + 1
    outside = (rows < 1) | (rows > height - 2) | (columns < 1) | (columns > width - 2)
    cells = np.where(outside, 0, rows * width + columns).astype(np.int32)
    angles = (poses[:, 2, None] + bearings).ravel()
    rays = np.empty((8, len(angles)), dtype=np.float32)
    rays[0], rays[1] = np.cos(angles), np.sin(angles)
    direction = rays[:2]
    direction[np.abs(direction) < MIN_DIRECTION] = MIN_DIRECTION
    rays[2:4] = np.repeat((poses[:, :2] - low).T, len(bearings), axis=1)
    rays[4:6] = np.where(direction > 0, 1 + nudge, -nudge)
    rays[6:] = 1 / direction
    return rays, np.repeat(cells, len(bearings))
