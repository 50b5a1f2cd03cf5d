"""The likelihood of laser beams at each position: the likelihood field and the beam model.

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

from .distances import cast_beams, clearances, distances

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Table = NDArray[np.float32]
Form = Literal["cube", "log"]


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
