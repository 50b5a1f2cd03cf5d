"""Growing maps and costmaps that follow the robot: each as its difference to the last, in runs of equal cells."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.geometry.products import matrix_product
from rosmini.viz.map_colours import UNKNOWN, colours_of, scheme_of
from rosmini.viz.replay.layers import Bounds, Frames, around
from rosmini.viz.replay.packing import ANGLE, LENGTH, pack, pack_columns, pack_natural
from rosmini.viz.rounding import fixed
from rosmini.viz.style import hex_colour
from rosmini.viz.view import ViewError

Cells = NDArray[np.uint8]

MAX_CELLS = 512
"""Maximum number of cells per side; in larger maps 2 x 2, 3 x 3, ... cells are combined."""
COSTS = 8
"""Costs of 1 to 98 are rounded to multiples of this: the difference is invisible, and runs become longer."""
MICROMETRE = 1e-6
MAX_ROTATION = 0.02
"""A map that is rotated by more than this [rad] is not encoded as a difference to the previous one."""


class Grid(NamedTuple):
    """A `nav_msgs/OccupancyGrid` at a moment: bytes (h, w), the first row at the origin, in the run's frame."""

    cells: Cells
    resolution: float
    """Side of a cell [m]."""
    origin: Pose


def grid(cells: NDArray[Any], resolution: float, origin: Pose) -> Grid:
    """Return a grid of at most `MAX_CELLS` a side. Raises `ViewError` if it has no cells or an invalid resolution."""
    if cells.ndim != 2 or not cells.size:
        raise ViewError(f"a map of {' x '.join(str(n) for n in cells.shape[::-1])} cells has nothing to show")
    if not (np.isfinite([resolution, *origin]).all() and resolution > 0):
        raise ViewError(f"a map needs finite numbers and cells of a positive size, not of {resolution} m, at {origin}")
    factor = -(-max(cells.shape) // MAX_CELLS)
    if factor > 1:
        cells, resolution = coarse(cells, factor), resolution * factor
    return Grid(cells.astype(np.uint8), resolution, origin)


def coarse(cells: NDArray[Any], factor: int) -> Cells:
    """Return cells (h, w) with each block of `factor` x `factor` combined into its highest known value."""
    height, width = (-(-n // factor) for n in cells.shape)
    known = np.full((height * factor, width * factor), -1, dtype=np.int16)
    known[: cells.shape[0], : cells.shape[1]] = cells.astype(np.uint8).astype(np.int16)
    known[known == UNKNOWN] = -1
    blocks = known.reshape(height, factor, width, factor).max(axis=(1, 3))
    return np.where(blocks < 0, UNKNOWN, blocks).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class Grids(Frames):
    """Maps or costmaps over time."""

    kind: ClassVar[str] = "grid"
    depth: ClassVar[int] = 0
    worth: ClassVar[float] = 2.0

    grids: tuple[Grid, ...]
    scheme: str = ""
    """The colour scheme, see `rosmini.viz.map_colours`; if empty, chosen by the topic's name."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.grids) != len(self.times):
            raise ViewError(f"the layer {self.name!r} has {len(self.times)} times but {len(self.grids)} maps")

    def at(self, which: NDArray[np.intp]) -> Self:
        """Return the layer with only these moments."""
        return replace(self, times=self.times[which], grids=tuple(self.grids[i] for i in which))

    def thinner(self) -> Self | None:
        """Return half of the moments, or, if there is only one, cells twice as wide."""
        if self.count > 1:
            return super().thinner()
        one = self.grids[0]
        if max(one.cells.shape) <= 64:
            return None
        halved = Grid(coarse(one.cells, 2), 2 * one.resolution, one.origin)
        return replace(self, grids=(halved,))

    @cached_property
    def colours(self) -> NDArray[np.uint8]:
        """The colour table (256, 4)."""
        return colours_of(self.scheme or scheme_of(self.name))

    def data(self) -> dict[str, Any]:
        """Return the maps, one after the other, in runs.

        | key | numbers |
        |---|---|
        | `colours` | as `#rrggbbaa`; the value of a cell is an index into them, 0 is unknown |
        | `places` | of each map: width, height, resolution [um], x, y [mm], heading [0.1 mrad]; offset of the last |
        | `counts` | the number of runs of each map |
        | `runs` | of each run: the number of unchanged cells before it, its length, the value of its cells |

        The previous map is placed at its offset; cells that it does not cover are unknown.
        """
        shown = [_rounded(each.cells) if self._is_costmap else each.cells for each in self.grids]
        used = np.unique(np.concatenate([np.array([UNKNOWN], dtype=np.uint8), *(cells.ravel() for cells in shown)]))
        values = [UNKNOWN, *(v for v in used.tolist() if v != UNKNOWN)]
        index = np.zeros(256, dtype=np.uint8)
        index[values] = np.arange(len(values))
        places, counts, runs = [], [], []
        before: tuple[Grid, Cells] | None = None
        for each, cells in zip(self.grids, shown, strict=True):
            numbers = index[cells]
            dx, dy = (0, 0) if before is None else _shift(before[0], each)
            base = pasted(None if before is None else before[1], numbers.shape, dx, dy)
            coded = runs_of(base.ravel(), numbers.ravel())
            height, width = numbers.shape
            places.append((width, height, each.resolution / MICROMETRE, *each.origin, dx, dy))
            counts.append(len(coded))
            runs.append(coded.ravel())
            before = each, numbers
        return {
            **self._head(),
            "colours": [hex_colour(self.colours[value].tolist()) for value in values],
            "places": pack_columns(places, 1, 1, 1, LENGTH, LENGTH, ANGLE, 1, 1),
            "counts": pack(np.array(counts, dtype=np.int64)),
            "runs": pack_natural(np.concatenate([np.empty(0, dtype=np.int64), *runs])),
        }

    @property
    def _is_costmap(self) -> bool:
        return (self.scheme or scheme_of(self.name)) in ("costmap", "safe")

    def text(self) -> str:
        """Report the number of maps, their size, and the known part at the end."""
        if not self.grids:
            return self._counted()
        cells, resolution, _ = self.grids[-1]
        known, full = np.mean(cells != UNKNOWN), np.mean((cells >= 65) & (cells <= 100))
        size = f"{cells.shape[1]} x {cells.shape[0]} cells of {fixed(resolution, 3)} m"
        parts = f"{fixed(100 * float(known), 0)}% known, {fixed(100 * float(full), 1)}% occupied"
        return f"{self._counted()}, the last {size}, {parts}"

    @property
    def bounds(self) -> Bounds | None:
        """Bounds of the known cells of the last map."""
        if not self.grids:
            return None
        cells, resolution, (x, y, heading) = self.grids[-1]
        rows, columns = np.nonzero(cells != UNKNOWN)
        if not len(rows):
            return None
        ends = np.array([(c, r) for c in (columns.min(), columns.max() + 1) for r in (rows.min(), rows.max() + 1)])
        c, s = np.cos(heading), np.sin(heading)
        return around([np.array([x, y]) + matrix_product(resolution * ends, np.array([[c, s], [-s, c]]))])


def _rounded(cells: Cells) -> Cells:
    """Return costs in steps of `COSTS`; free, inscribed, lethal and unknown cells keep their values."""
    return np.where((cells > 0) & (cells < 99), np.clip(cells // COSTS * COSTS, 1, 98), cells).astype(np.uint8)


def _shift(before: Grid, after: Grid) -> tuple[int, int]:
    """Return the offset of one grid in another, in cells; if their cells do not align, an offset outside the other."""
    if before.resolution != after.resolution or abs(before.origin[2] - after.origin[2]) > MAX_ROTATION:
        return (after.cells.shape[1], after.cells.shape[0])
    x, y = before.origin[0] - after.origin[0], before.origin[1] - after.origin[1]
    heading = after.origin[2]
    c, s = np.cos(heading), np.sin(heading)
    along, across = (c * x + s * y) / after.resolution, (-s * x + c * y) / after.resolution
    wide, high = 2 * MAX_CELLS, 2 * MAX_CELLS
    return (int(np.clip(np.rint(along), -wide, wide)), int(np.clip(np.rint(across), -high, high)))


def pasted(before: Cells | None, shape: tuple[int, ...], dx: int, dy: int) -> Cells:
    """Return cells of a shape (h, w) that contain others, the first at column `dx` and row `dy`; the rest is 0."""
    cells = np.zeros(shape, dtype=np.uint8)
    if before is None:
        return cells
    height, width = shape
    x0, x1 = max(0, dx), min(width, dx + before.shape[1])
    y0, y1 = max(0, dy), min(height, dy + before.shape[0])
    if x0 < x1 and y0 < y1:
        cells[y0:y1, x0:x1] = before[y0 - dy : y1 - dy, x0 - dx : x1 - dx]
    return cells


def runs_of(before: Cells, after: Cells) -> NDArray[np.int64]:
    """Return the differences between two rows (n,) as runs (m, 3): number of unchanged cells, run length, value."""
    changed = before != after
    starts = np.flatnonzero(np.diff(changed, prepend=False) | (changed & (np.diff(after, prepend=after[:1]) != 0)))
    if not len(starts):
        return np.empty((0, 3), dtype=np.int64)
    ends = np.append(starts[1:], len(after))
    real = changed[starts]
    starts, ends = starts[real], ends[real]
    gaps = starts - np.concatenate([[0], ends[:-1]])
    return np.column_stack([gaps, ends - starts, after[starts]]).astype(np.int64)
