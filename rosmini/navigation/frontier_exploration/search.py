"""Frontiers: where what is known to be free borders on the unknown.

A frontier cell is unknown and has a free cell on one of its four sides; a frontier is a set of such cells that are
neighbours, corners included (Yamauchi 1997, with the roles that the packages `frontier_exploration` and `explore_lite`
give to the cells). The search spreads from the robot over cells where its centre may be, so a frontier that none of
them leads to is not found.

From the originals differ: they spread over free cells only, from the nearest one, and end early where that one is shut
in, between the legs of a chair or behind a door in which inflation leaves no free cell. The cell that a frontier was
found by counts for its centroid and its distance, too. There the sum leaves it out and is divided by all, so that small
frontiers have centroids nearer to the map's origin. And the middle is in the middle. There it is the cell nearest to
the robot, which most often lies at the end of a wall, where the robot that is sent there gets stuck.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
)

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]
Point = tuple[float, float]

TOLERANCE = 5
"""Goals nearer than so many cells, along both axes, to one that was given up count as given up, as in explore_lite."""
TRIES = 2
"""A goal that was given up so often is given up for good. What was in the way may be gone: a person, or a shut door."""
SOME = 5
"""So many places are told."""


@dataclass(frozen=True, eq=False)
class Frontier:
    """Cells (n, 2) of one frontier, each (mx, my), the one first; lengths in metres."""

    cells: Ints
    """In the order in which they were found."""
    points: NDArray[np.float64]
    """Their middles (n, 2) [m]."""
    min_distance: float
    """From the middle of the robot's cell to the nearest [m]."""
    initial: Point
    """The cell that the search met first."""
    middle: Point
    """The cell nearest to the centroid."""
    centroid: Point
    """The mean of all; it need not be in one of the cells."""

    @property
    def size(self) -> int:
        """How many cells it has."""
        return len(self.cells)


def frontier_cells(costs: NDArray[np.uint8]) -> Bools:
    """Which cells (h, w) of a grid of costs are unknown beside a free one."""
    free = np.pad(costs == FREE_SPACE, 1)
    beside = free[:-2, 1:-1] | free[2:, 1:-1] | free[1:-1, :-2] | free[1:-1, 2:]
    cells: Bools = beside & (costs == NO_INFORMATION)
    return cells


def find_frontiers(grid: Costmap2D, x: float, y: float) -> list[Frontier]:
    """The frontiers that a robot gets to from a point [m], in the order in which the search meets them.

    It begins at the cell nearest to the point in which the robot's centre may be. Raises `IndexError` if the point is
    outside of the grid.
    """
    cell = grid.world_to_map(x, y)
    if cell is None:
        raise IndexError(f"the robot, at ({x:.2f}, {y:.2f}), is outside of {grid!r}")
    open_cells = np.argwhere(grid.costs < INSCRIBED_INFLATED_OBSTACLE)
    if not len(open_cells):
        return []
    off = open_cells - np.array([cell[1], cell[0]])
    nearest = np.lexsort(((off * off).sum(axis=1), np.abs(off).max(axis=1)))[0]
    here = grid.map_to_world(*cell)
    return [_measured(grid, cells, here) for cells in _groups(grid.costs, open_cells[nearest])]


def places(points: Iterable[Point]) -> str:
    """Points [m] as text, `SOME` at most.

    >>> places([(1.0, 2.0), (0.5, 0.25)])
    '(1.00, 2.00), (0.50, 0.25)'
    """
    texts = [f"({x:.2f}, {y:.2f})" for x, y in points]
    more = [f"and {len(texts) - SOME} more"] if len(texts) > SOME else []
    return ", ".join(texts[:SOME] + more)


def _measured(grid: Costmap2D, cells: Ints, here: Point) -> Frontier:
    """A frontier of these cells, seen from `here` [m]."""
    points = np.array(grid.origin) + (cells + 0.5) * grid.resolution
    distances = np.hypot(points[:, 0] - here[0], points[:, 1] - here[1])
    ix, iy = points[0].tolist()
    cx, cy = points.mean(axis=0).tolist()
    mx, my = points[np.hypot(points[:, 0] - cx, points[:, 1] - cy).argmin()].tolist()
    return Frontier(cells, points, float(distances.min()), (ix, iy), (mx, my), (cx, cy))


def _groups(costs: NDArray[np.uint8], start: Ints) -> Iterator[Ints]:
    """The cells (n, 2) of each frontier that is met from the cell `start` (row, column)."""
    # With a rim of walls every neighbour is in the array, and a cell is one number.
    padded = np.pad(costs, 1, constant_values=LETHAL_OBSTACLE)
    width = padded.shape[1]
    waiting = bytearray(frontier_cells(padded).tobytes())
    around = [sign * step for step in (1, width, width - 1, width + 1) for sign in (-1, 1)]
    for first in _met(padded, int((start[0] + 1) * width + start[1] + 1)):
        if not waiting[first]:
            continue
        waiting[first] = 0
        found = [first]
        for cell in found:  # it grows meanwhile
            for step in around:
                if waiting[cell + step]:
                    waiting[cell + step] = 0
                    found.append(cell + step)
        numbers = np.array(found)
        yield np.stack([numbers % width - 1, numbers // width - 1], axis=1)


def _met(padded: NDArray[np.uint8], start: int) -> list[int]:
    """The unknown cells beside those that a breadth-first search from a cell reaches, in order, some repeatedly."""
    costs = padded.ravel()
    unknown, is_open = costs == NO_INFORMATION, costs < INSCRIBED_INFLATED_OBSTACLE
    steps = np.array([-1, 1, -padded.shape[1], padded.shape[1]])
    rank = np.zeros(len(costs), dtype=np.int64)
    wave = np.array([start])
    is_open[start] = False
    met: list[int] = []
    while len(wave):
        beside = (wave[:, None] + steps).ravel()
        met += beside[unknown[beside]].tolist()
        fresh = beside[is_open[beside]]
        # Of a cell that several led to the first stays: a queue would have it there.
        rank[fresh[::-1]] = np.arange(len(fresh))[::-1]
        wave = fresh[rank[fresh] == np.arange(len(fresh))]
        is_open[wave] = False
    return met


@dataclass
class Blacklist:
    """Goals that were given up, or left [m], one as often as that happened."""

    points: list[Point] = field(default_factory=list)

    def count(self, point: Point, resolution: float) -> int:
        """How often a goal next to this point was given up."""
        reach = TOLERANCE * resolution
        return sum(abs(point[0] - x) < reach and abs(point[1] - y) < reach for x, y in self.points)

    def has(self, point: Point, resolution: float) -> bool:
        """Whether a point was given up for good."""
        return self.count(point, resolution) >= TRIES
