"""Frontiers: borders between known free cells and unknown cells.

A frontier cell is unknown and has a free cell on one of its four sides; a frontier is a connected set of such cells,
corners included (Yamauchi 1997, with the roles that the packages `frontier_exploration` and `explore_lite` give to the
cells). The search spreads from the robot over the cells where its centre may be, so it does not find frontiers that
the robot cannot reach.

There are three differences from the originals:

- The originals spread only over free cells, from the nearest one, and end early if that one is enclosed, between the
  legs of a chair or behind a door where inflation leaves no free cell.
- In the originals, the sum for the centroid omits the frontier's first cell but is divided by the full count, so small
  frontiers have centroids nearer to the map's origin. Here the first cell counts, also for the distance.
- The originals' middle is the cell nearest to the robot, usually at the end of a wall, where a robot gets stuck. Here
  it is in the middle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
)

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
Point = tuple[float, float]

SAME_GOAL_CELLS = 5
"""Goals within this many cells of a given-up goal, along both axes, also count as given up, as in explore_lite."""
MAX_FAILURES = 2
"""Number of failures after which a goal is given up permanently; after the first, the obstacle may have moved."""
MAX_LISTED = 5
"""Maximum number of positions in a message."""


@dataclass(frozen=True, eq=False)
class Frontier:
    """A connected set of frontier cells; positions and lengths are in metres."""

    cells: Ints
    """The cells (n, 2), each (mx, my), in the order of discovery."""
    points: NDArray[np.float64]
    """The centres of the cells (n, 2) [m]."""
    min_distance: float
    """Distance from the centre of the robot's cell to the nearest cell [m]."""
    initial: Point
    """The centre of the cell that the search found first."""
    middle: Point
    """The centre of the cell nearest to the centroid."""
    centroid: Point
    """The mean of all cells; it need not be in one of them."""

    @property
    def size(self) -> int:
        """The number of cells."""
        return len(self.cells)


def frontier_cells(costs: NDArray[np.uint8]) -> Bools:
    """Return a mask (h, w) of the cells of a cost grid that are unknown and beside a free one."""
    free = np.pad(costs == FREE_SPACE, 1)
    beside = free[:-2, 1:-1] | free[2:, 1:-1] | free[1:-1, :-2] | free[1:-1, 2:]
    cells: Bools = beside & (costs == NO_INFORMATION)
    return cells


def find_frontiers(grid: Costmap2D, x: float, y: float) -> list[Frontier]:
    """Return the frontiers that a robot can reach from a point [m], in the order of discovery.

    The search starts at the cell nearest to the point where the robot's centre may be. Raises `IndexError` if the point
    is outside the grid.
    """
    cell = grid.world_to_map(x, y)
    if cell is None:
        raise IndexError(f"the robot, at ({x:.2f}, {y:.2f}), is outside {grid!r}")
    open_cells = np.argwhere(grid.costs < INSCRIBED_INFLATED_OBSTACLE)
    if not len(open_cells):
        return []
    off = open_cells - np.array([cell[1], cell[0]])
    nearest = np.lexsort(((off * off).sum(axis=1), np.abs(off).max(axis=1)))[0]
    here = grid.map_to_world(*cell)
    return [_measured(grid, cells, here) for cells in _groups(grid.costs, open_cells[nearest])]


def formatted_points(points: Iterable[Point]) -> str:
    """Return points [m] as text, at most `MAX_LISTED` of them.

    >>> formatted_points([(1.0, 2.0), (0.5, 0.25)])
    '(1.00, 2.00), (0.50, 0.25)'
    """
    texts = [f"({x:.2f}, {y:.2f})" for x, y in points]
    more = [f"and {len(texts) - MAX_LISTED} more"] if len(texts) > MAX_LISTED else []
    return ", ".join(texts[:MAX_LISTED] + more)


def _measured(grid: Costmap2D, cells: Ints, here: Point) -> Frontier:
    """Return the frontier of these cells, with its distance from `here` [m]."""
    points = np.array(grid.origin) + (cells + 0.5) * grid.resolution
    distances = np.hypot(points[:, 0] - here[0], points[:, 1] - here[1])
    ix, iy = points[0].tolist()
    cx, cy = points.mean(axis=0).tolist()
    mx, my = points[np.hypot(points[:, 0] - cx, points[:, 1] - cy).argmin()].tolist()
    return Frontier(cells, points, float(distances.min()), (ix, iy), (mx, my), (cx, cy))


def _groups(costs: NDArray[np.uint8], start: Ints) -> Iterator[Ints]:
    """Yield the cells (n, 2) of each frontier in the order of discovery from the cell `start` (row, column)."""
    # With a rim of obstacles every neighbour has a valid index, and a cell is one number.
    padded = np.pad(costs, 1, constant_values=LETHAL_OBSTACLE)
    width = padded.shape[1]
    waiting = bytearray(frontier_cells(padded).tobytes())
    around = [sign * step for step in (1, width, width - 1, width + 1) for sign in (-1, 1)]
    for first in _reached_unknown(padded, int((start[0] + 1) * width + start[1] + 1)):
        if not waiting[first]:
            continue
        waiting[first] = 0
        found = [first]
        for cell in found:  # the list grows during the loop
            for step in around:
                if waiting[cell + step]:
                    waiting[cell + step] = 0
                    found.append(cell + step)
        numbers = np.array(found)
        yield np.stack([numbers % width - 1, numbers // width - 1], axis=1)


def _reached_unknown(padded: NDArray[np.uint8], start: int) -> list[int]:
    """Return the unknown cells next to the passable ones that a breadth-first search from `start` reaches.

    They are in the order of the search, with duplicates. Cells are indices into `padded` (h, w), row by row.
    """
    costs = padded.ravel()
    unknown, is_open = costs == NO_INFORMATION, costs < INSCRIBED_INFLATED_OBSTACLE
    steps = np.array([-1, 1, -padded.shape[1], padded.shape[1]])
    rank = np.zeros(len(costs), dtype=np.int64)
    wave = np.array([start])
    is_open[start] = False
    found: list[int] = []
    while len(wave):
        beside = (wave[:, None] + steps).ravel()
        found += beside[unknown[beside]].tolist()
        fresh = beside[is_open[beside]]
        # Keep the first occurrence of each cell, as a queue would.
        rank[fresh[::-1]] = np.arange(len(fresh))[::-1]
        wave = fresh[rank[fresh] == np.arange(len(fresh))]
        is_open[wave] = False
    return found


@dataclass
class Blacklist:
    """Goals [m] that were given up or replaced, with one entry for each time."""

    points: list[Point] = field(default_factory=list)

    def count(self, point: Point, resolution: float) -> int:
        """Return how often goals near a point [m] were given up or replaced; `resolution` is the side of a cell [m]."""
        reach = SAME_GOAL_CELLS * resolution
        return sum(abs(point[0] - x) < reach and abs(point[1] - y) < reach for x, y in self.points)

    def is_given_up(self, point: Point, resolution: float) -> bool:
        """Return whether goals near a point [m] were given up or replaced at least `MAX_FAILURES` times."""
        return self.count(point, resolution) >= MAX_FAILURES
