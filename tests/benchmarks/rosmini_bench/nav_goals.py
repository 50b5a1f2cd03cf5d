"""Where a navigating robot is sent: starts and goals drawn at random, and how far it is between them at the least.

A start and a goal lie where the centre of a disc of `DISC` can get to; the shortest path keeps `CLEARANCE` to all that
is in the map. Both come from the same exact distances, which know nothing of costmaps.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.poses import Pose
from rosmini.core.maps import GridMap
from rosmini.sim.motion import Door
from rosmini.sim.world import Obstacle, World
from rosmini.sim.worlds.world_map import to_map

DISC = 0.20
"""Starts and goals are where a disc of this radius [m] gets to."""
NARROW = 0.15
"""Goals in narrower places are where only one of this radius [m] gets to."""
CLEARANCE = 0.15
"""What the shortest path keeps from everything [m]."""
APART = 3.0
"""Start and goal are at least so far apart [m]."""

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Cell = tuple[int, int]

STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Half of the eight neighbours (rows, columns); the others are the way back."""


@dataclass(frozen=True)
class Errand:
    """One goal: from where to where, and the least that it takes."""

    number: int
    start: Pose
    goal: Pose
    shortest: float
    """The length [m] of the shortest path at `CLEARANCE`."""
    turning: float
    """By how much [rad] a robot turns on it, at both ends too."""


class Terrain:
    """A map of which it is known how far each cell is from what is occupied or unknown."""

    def __init__(self, grid: GridMap) -> None:
        self.grid = grid
        free = grid.free
        # Between the middle of a free cell and the nearest edge of what is not free lies half a cell less.
        self.distance: Floats = (ndimage.distance_transform_edt(free) - 0.5) * grid.resolution

    def within(self, clearance: float, inside: Cell) -> Bools:
        """The cells (h, w) whose middle keeps `clearance` [m] and that are joined with the cell `inside`."""
        labels, _ = ndimage.label(self.distance >= clearance)
        wanted: Bools = (labels == labels[inside]) & (labels[inside] > 0)
        return wanted

    def cell(self, x: float, y: float) -> Cell:
        """The cell (row, column) of a point [m]."""
        left, low, _ = self.grid.origin
        return int((y - low) // self.grid.resolution), int((x - left) // self.grid.resolution)

    def point(self, cell: Cell) -> tuple[float, float]:
        """The middle of a cell (row, column) [m]."""
        left, low, _ = self.grid.origin
        return left + (cell[1] + 0.5) * self.grid.resolution, low + (cell[0] + 0.5) * self.grid.resolution

    @cached_property
    def _roads(self) -> tuple[NDArray[np.int64], sparse.csr_matrix]:
        """The number of each cell (-1 where there is no room), and the lengths between neighbours [cells]."""
        room = self.distance >= CLEARANCE
        numbers = np.where(room, np.cumsum(room).reshape(room.shape) - 1, -1)
        rows: list[NDArray[np.int64]] = []
        columns, lengths = [], []
        for dr, dc in STEPS:
            here = numbers[: numbers.shape[0] - dr, max(0, -dc) : numbers.shape[1] - max(0, dc)]
            there = numbers[dr:, max(0, dc) : numbers.shape[1] - max(0, -dc)]
            joined = (here >= 0) & (there >= 0)
            rows.append(here[joined])
            columns.append(there[joined])
            lengths.append(np.full(int(joined.sum()), math.hypot(dr, dc)))
        count = int(room.sum())
        roads = sparse.csr_matrix(
            (np.concatenate(lengths), (np.concatenate(rows), np.concatenate(columns))), shape=(count, count)
        )
        return numbers, roads

    def shortest(self, start: Cell, goal: Cell) -> list[tuple[float, float]] | None:
        """The corners of a shortest path at `CLEARANCE`, pulled tight; None if there is none."""
        numbers, roads = self._roads
        first, last = int(numbers[start]), int(numbers[goal])
        if first < 0 or last < 0:
            return None
        _, before = csgraph.dijkstra(roads, directed=False, indices=first, return_predecessors=True)
        if before[last] < 0:
            return None
        cells = np.argwhere(numbers >= 0)
        way = [last]
        while way[-1] != first:
            way.append(int(before[way[-1]]))
        return self._pulled([(int(r), int(c)) for r, c in cells[way[::-1]]])

    def _pulled(self, way: list[Cell]) -> list[tuple[float, float]]:
        """The same path without the corners that only the grid asks for."""
        kept = [way[0]]
        here = 0
        while here < len(way) - 1:
            ahead = len(way) - 1
            while ahead > here + 1 and not self._sees(way[here], way[ahead]):
                ahead -= max(1, (ahead - here) // 20)
            here = max(ahead, here + 1)
            kept.append(way[here])
        return [self.point(cell) for cell in kept]

    def _sees(self, a: Cell, b: Cell) -> bool:
        """Whether a straight line keeps the clearance."""
        count = 2 * max(abs(a[0] - b[0]), abs(a[1] - b[1])) + 1
        rows = np.rint(np.linspace(a[0], b[0], count)).astype(int)
        columns = np.rint(np.linspace(a[1], b[1], count)).astype(int)
        return bool((self.distance[rows, columns] >= CLEARANCE).all())


def turning(path: list[tuple[float, float]], start: Pose, goal: Pose) -> float:
    """By how much [rad] a robot turns that stands at `start`, drives along the path, and stands at `goal`."""
    headings = [math.atan2(by - ay, bx - ax) for (ax, ay), (bx, by) in itertools.pairwise(path)]
    turns = [start[2], *headings, goal[2]]
    return sum(abs(math.remainder(b - a, math.tau)) for a, b in itertools.pairwise(turns))


def unmapped(world: World) -> Bools:
    """Cells (h, w) that are free in a world's map only: where things to push stand, and where doors swing."""
    things: list[Obstacle] = []
    for each in world.obstacles:
        if isinstance(each.motion, Door):
            times = np.linspace(0.0, each.motion.period, 60)
            places = {each.at(float(t)) for t in times}
            things += [
                replace(each, name=f"{each.name} {i}", pose=place, motion=None)
                for i, place in enumerate(sorted(places))
            ]
        elif each.movable:
            things.append(replace(each, mass=None))
    fixed = [each for each in world.obstacles if each.fixed]
    taken: Bools = to_map(world.with_just([*fixed, *things])).occupied & to_map(world).free
    return taken


def errands(
    grid: GridMap,
    inside: tuple[float, float],
    count: int,
    seed: int,
    taken: Bools | None = None,
    *,
    disc: float = DISC,
    narrow: bool = False,
) -> Iterator[Errand]:
    """`count` errands in the part of a map that a disc [m] reaches from the point `inside` [m], of any headings.

    Nothing begins or ends where the disc would overlap with `taken` cells (h, w), which only who is there sees. With
    `narrow` goals are where it has no room, and one of `NARROW` has.
    Raises `RosminiError` if a thousand draws in sequence find no pair far enough apart.
    """
    terrain = Terrain(grid)
    room = terrain.within(disc, terrain.cell(*inside))
    ends = terrain.within(NARROW, terrain.cell(*inside)) & ~room if narrow else room
    if taken is not None and taken.any():
        away = (ndimage.distance_transform_edt(~taken) - 0.5) * grid.resolution >= disc
        room, ends = room & away, ends & away
    places, targets = np.argwhere(room), np.argwhere(ends)
    if not len(places):
        raise RosminiError(f"a disc of {disc:g} m has no room at {inside}: name a point farther from the walls")
    draw = np.random.default_rng([seed, len(places)])
    number = failed = 0
    while number < count:
        a, b = (tuple(map(int, some[draw.integers(len(some))])) for some in (places, targets))
        headings = draw.uniform(-math.pi, math.pi, 2)
        (ax, ay), (bx, by) = terrain.point((a[0], a[1])), terrain.point((b[0], b[1]))
        path = terrain.shortest((a[0], a[1]), (b[0], b[1])) if math.hypot(bx - ax, by - ay) >= APART else None
        if path is None:
            failed += 1
            if failed == 1000:
                raise RosminiError(f"{grid!r} has no two places {APART} m apart: take a larger one")
            continue
        failed = 0
        start, goal = (ax, ay, float(headings[0])), (bx, by, float(headings[1]))
        length = sum(math.dist(p, q) for p, q in itertools.pairwise(path))
        yield Errand(number, start, goal, length, turning(path, start, goal))
        number += 1


def wilson(successes: int, count: int, z: float = 1.959964) -> tuple[float, float]:
    """The 95 % interval of a share after Wilson (1927), which is honest near 0 and 1 and for few trials."""
    if not count:
        return 0.0, 1.0
    share = successes / count
    middle = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return max(0.0, middle - half), min(1.0, middle + half)
