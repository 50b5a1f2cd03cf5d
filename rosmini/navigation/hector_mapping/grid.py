"""A map of hector_mapping: log-odds, and the probabilities that the matcher interpolates."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.maps.grid_map import FREE, OCCUPIED, UNKNOWN, GridMap

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Integers = NDArray[np.int64]

MAX_LOG_ODDS = 50.0
"""Log-odds of this value or more are not raised, as in the original; there is no lower bound."""


def log_odds(probability: float) -> float:
    """Return the logarithm of the odds. Raises `RosminiError` unless the probability is between 0 and 1."""
    if not 0 < probability < 1:
        raise RosminiError(f"the update factor {probability} must be a probability between 0 and 1")
    return math.log(probability / (1 - probability))


class OccupancyGrid:
    """Cells (h, w) of `resolution` [m], row 0 at the bottom; the centre of cell (0, 0) is at `origin` [m].

    `free` and `occupied` are the occupancy probabilities that a single scan gives to a cell that a beam passes, and to
    a cell in which a beam ends (`update_factor_free`, `update_factor_occupied`).
    """

    def __init__(
        self,
        shape: tuple[int, int],
        resolution: float,
        origin: tuple[float, float],
        *,
        free: float = 0.4,
        occupied: float = 0.9,
    ) -> None:
        self.resolution, self.origin = resolution, origin
        self.odds: Singles = np.zeros(shape, dtype=np.float32)
        self.probabilities: Singles = np.full(shape, 0.5, dtype=np.float32)
        self._free, self._occupied = np.float32(log_odds(free)), np.float32(log_odds(occupied))

    def __repr__(self) -> str:
        height, width = self.odds.shape
        return f"<OccupancyGrid: {width} x {height} cells of {self.resolution:g} m>"

    def __contains__(self, point: tuple[float, float]) -> bool:
        """Return whether a point [m] is in a cell of the map."""
        (x, y), (height, width) = self.cells(np.asarray(point)), self.odds.shape
        return bool(-0.5 <= x < width - 0.5 and -0.5 <= y < height - 0.5)

    def cells(self, points: Floats) -> Floats:
        """Return points (..., 2) [m] in cells (column, row); whole numbers are cell centres."""
        return (points - self.origin) / self.resolution

    def update(self, start: tuple[float, float], ends: Floats) -> None:
        """Add beams from `start` to `ends` (b, 2) [m]; each cell changes once, and a hit takes precedence over passing.

        A beam that ends outside the map, or in the cell where it starts, changes nothing.
        """
        first = _nearest(self.cells(np.asarray(start)))
        last = _nearest(self.cells(ends))
        height, width = self.odds.shape
        inside = ((last >= 0) & (last < (width, height))).all(axis=1) & (last != first).any(axis=1)
        if not (0 <= first[0] < width and 0 <= first[1] < height and inside.any()):
            return
        last = last[inside]
        # Process only the part of the map that these beams can touch.
        left, low = np.minimum(last.min(axis=0), first)
        right, high = np.maximum(last.max(axis=0), first) + 1
        kinds = np.zeros((high - low, right - left), dtype=np.int8)
        columns, rows = passed_cells(first, last)
        kinds[rows - low, columns - left] = 1
        kinds[last[:, 1] - low, last[:, 0] - left] = 2
        odds = self.odds[low:high, left:right]
        odds[kinds == 1] += self._free
        odds[(kinds == 2) & (odds < MAX_LOG_ODDS)] += self._occupied
        changed = kinds > 0
        # The bounds avoid overflow: the lower one here does not change the result, `MAX_LOG_ODDS` is the upper one.
        some = np.exp(np.maximum(odds[changed].astype(np.float64), -80.0))
        self.probabilities[low:high, left:right][changed] = some / (1 + some)

    def as_map(self) -> GridMap:
        """Return a grid map: occupied cells if that is likelier than free, free if not, unknown if both are equal."""
        found = np.full(self.odds.shape, UNKNOWN, dtype=np.int8)
        found[self.odds < 0], found[self.odds > 0] = FREE, OCCUPIED
        half = self.resolution / 2
        return GridMap(found, self.resolution, (self.origin[0] - half, self.origin[1] - half, 0.0))


def _nearest(cells: Floats) -> Integers:
    found: Integers = np.floor(cells + 0.5).astype(np.int64)
    return found


def passed_cells(first: Integers, last: Integers) -> tuple[Integers, Integers]:
    """Return columns and rows of the cells on lines from `first` (2,) to each of `last` (n, 2), without the last cells.

    One cell per step along the longer side (Bresenham, Algorithm for computer control of a digital plotter, 1965).
    """
    span = (last - first).astype(np.float64)
    steps = np.abs(span).max(axis=1)
    count = steps.astype(np.intp)
    before = np.cumsum(count) - count
    step = np.arange(before[-1] + count[-1]) - np.repeat(before, count)
    # The values are multiples of 1 / steps plus half of that, so that rounding errors have no effect.
    half = (steps // 2 + 0.5) / steps
    columns, rows = (
        first[axis]
        + (np.repeat(np.sign(along) * half, count) + step * np.repeat(along / steps, count)).astype(np.int64)
        for axis, along in enumerate(span.T)
    )
    return columns, rows
