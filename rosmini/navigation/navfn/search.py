"""Searches on cost grids, which can be run in parts.

A search takes costs (h, w) as in `Costmap2D`, and start and goal as cells (column, row); whole numbers are cell
centres. It works on a copy with a lethal rim, in which the start's cell is free, because the robot is there. (The
originals write both into the costmap itself, where the next update has to repair them.)
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
)
from rosmini.navigation.nav_core.failures import GoalBlocked, NoPath, OutsideMap, PlanningFailure, StartBlocked

from .descent import FULL, compiled_descend
from .wave import ARRIVED, EXPANDED, HIGH, compiled_wave

Point = tuple[float, float]
Points = NDArray[np.float64]

UNLIMITED = 1 << 62
"""A number greater than that of all cells."""
MEANING = {
    INSCRIBED_INFLATED_OBSTACLE: "nearer to an obstacle than the robot's inscribed radius",
    LETHAL_OBSTACLE: "an obstacle, or at the map's edge",
    NO_INFORMATION: "unknown",
}
"""Descriptions of special costs of a goal's cell."""


class Search(ABC):
    """A search from a start to a goal on a cost grid; the subclasses contain the differences between planners."""

    def __init__(
        self,
        costs: NDArray[np.uint8],
        table: NDArray[np.float32],
        start: Point,
        goal: Point,
        *,
        quadratic: bool = True,
        grid_path: bool = False,
    ) -> None:
        """Prepare the search.

        `table` is the cost of entering a cell by its cost value (256,), infinite if impassable. With `quadratic`
        potentials are interpolated between two neighbours. With `grid_path` paths lead from cell to cell.

        Raises `OutsideMap` if start or goal is outside the grid.
        """
        self.height: int = costs.shape[0]
        self.width: int = costs.shape[1]
        self.start, self.goal = start, goal
        for what, point in (("start", start), ("goal", goal)):
            if not self._inside(point):
                raise OutsideMap(
                    f"the {what} {_shown(point)} is outside the map of {self.width} x {self.height} cells",
                    point=point,
                    size=(self.width, self.height),
                )
        self.table = table
        self.quadratic, self.grid_path = quadratic, grid_path
        self.arrived = self.finished = False
        self.row: int = self.width + 2
        """Number of cells in a row, including the rim."""
        self.entering_goal = float(table[costs[cell_of(goal)[1], cell_of(goal)[0]]])
        self.goal_cost = int(costs[cell_of(goal)[1], cell_of(goal)[0]])
        self.costs = np.full((self.height + 2, self.row), LETHAL_OBSTACLE, dtype=np.uint8)
        self.costs[1:-1, 1:-1] = costs
        self.costs.ravel()[self._index(cell_of(start))] = 0
        self.potential_with_rim = np.full(self.costs.size, HIGH, dtype=np.float32)
        """The potential of all cells, row by row, including the rim."""
        self._stop = self._index(cell_of(goal))

    def _inside(self, point: Point) -> bool:
        column, row = cell_of(point)
        return 0 <= column < self.width and 0 <= row < self.height

    def _index(self, cell: tuple[int, int]) -> int:
        return (cell[1] + 1) * self.row + cell[0] + 1

    @property
    def potential(self) -> NDArray[np.float32]:
        """The path cost of each cell (h, w); `HIGH` for cells that were not reached. This is not a copy."""
        return self.potential_with_rim.reshape(self.costs.shape)[1:-1, 1:-1]

    @property
    def reached(self) -> NDArray[np.bool_]:
        """True for each cell (h, w) that has a potential."""
        return np.asarray(self.potential < HIGH)

    @property
    @abstractmethod
    def expanded(self) -> int:
        """The number of expansions so far; cells that were expanded twice count twice."""

    def expand(self, count: int = UNLIMITED) -> bool:
        """Expand up to `count` cells; return True once the search is finished."""
        if not self.finished and count > 0:
            result = self._expand(count)
            self.finished, self.arrived = result != 0, result == ARRIVED
        return self.finished

    def path(self) -> Points:
        """Return the path from start to goal (n, 2), in columns and rows.

        Raises a `PlanningFailure` with the reason if there is no path.
        """
        self.expand()
        return self.path_to(self.goal)

    def path_to(self, goal: Point) -> Points:
        """Return the path from the start to any point (n, 2), in columns and rows, as far as the search has come.

        Raises a `PlanningFailure` if the point has not been reached.
        """
        if not self._inside(goal) or self.potential_with_rim[self._index(cell_of(goal))] >= HIGH:
            raise self.failure()
        walk = compiled_descend()
        begin, end = (goal[0] + 1, goal[1] + 1), (self.start[0] + 1, self.start[1] + 1)
        room = 8 * (self.width + self.height) + 64
        while True:
            points = np.empty(2 * room)
            found = walk(self.potential_with_rim, self.row, *begin, *end, int(not self.grid_path), points)
            if found != FULL:
                break
            room *= 4
        if found < 0:
            raise PlanningFailure(
                f"a potential was found at the goal {_shown(goal)}, but no path from the start "
                f"{_shown(self.start)}. This shouldn't happen.",
                goal=goal,
                start=self.start,
            )
        return np.asarray(points[: 2 * found].reshape(-1, 2)[::-1] - 1)

    def potential_at(self, cell: tuple[int, int]) -> float:
        """Return the potential of a cell; `HIGH` outside the grid."""
        return float(self.potential_with_rim[self._index(cell)]) if self._inside(cell) else HIGH

    def failure(self, grid: Costmap2D | None = None) -> PlanningFailure:
        """Return the reason why there is no path: see `search_failure`."""
        return search_failure(self, grid)

    @abstractmethod
    def _expand(self, count: int) -> int: ...


def search_failure(search: Search, grid: Costmap2D | None = None) -> PlanningFailure:
    """Return the failure of a finished search that did not reach its goal; its text is in metres if a grid is given.

    Its numbers are `start`, `goal`, `goal_cost`, `reachable` [cells], `nearest` (the reachable cell nearest to the
    goal), and the `distance` from there to the goal (in cells, or metres if a grid is given).
    """
    reached = search.reached
    count = int(reached.sum())
    rows, columns = np.nonzero(reached)
    away = np.hypot(columns - search.goal[0], rows - search.goal[1])
    best = int(away.argmin())
    nearest = (int(columns[best]), int(rows[best]))
    scale = 1.0 if grid is None else grid.resolution
    numbers: dict[str, Any] = {
        "start": search.start,
        "goal": search.goal,
        "goal_cost": search.goal_cost,
        "reachable": count,
        "nearest": nearest,
        "distance": float(away[best]) * scale,
    }
    area = f"{count} cells" if grid is None else f"{count * scale * scale:.2f} m2"
    unit = "cells" if grid is None else "m"
    close = f"the robot can get to {_place(nearest, grid)}, {numbers['distance']:.2f} {unit} from it"
    start, goal = _place(search.start, grid), _place(search.goal, grid)
    if count == 1:
        return StartBlocked(
            f"the start {start} is shut in: no plan may enter a cell beside it. Clear the costmap, or drive the robot "
            "away from what it touches",
            **numbers,
        )
    if not math.isfinite(search.entering_goal):
        meaning = MEANING.get(search.goal_cost, "taken as lethal")
        return GoalBlocked(
            f"the goal {goal} is blocked: its cell has the cost {search.goal_cost}, {meaning}; {close}. Move the "
            "goal, or allow a tolerance",
            **numbers,
        )
    return NoPath(
        f"no path leads from the start {start} to the goal {goal}: {area} can be reached from the start, and {close}. "
        "Something is in the way, or the passage is narrower than the inscribed radius on both sides",
        **numbers,
    )


def _place(cell: tuple[float, float], grid: Costmap2D | None) -> str:
    if grid is None:
        return f"({cell[0]:g}, {cell[1]:g})"
    x, y = grid.map_to_world(*cell)
    return f"({x:.2f}, {y:.2f})"


class WaveSearch(Search):
    """A search by `wave`, shared by navfn and the Dijkstra search of global_planner."""

    def __init__(
        self,
        costs: NDArray[np.uint8],
        table: NDArray[np.float32],
        start: Point,
        goal: Point,
        *,
        threshold: float,
        rise: float,
        heuristic: float = 0.0,
        full: bool = False,
        quadratic: bool = True,
        grid_path: bool = False,
    ) -> None:
        """Prepare the search. With `full` it continues after reaching the goal.

        `heuristic` is that of `wave`. The first threshold of the wave is `threshold`, plus `heuristic` for each cell of
        distance from start to goal; `rise` is its increment.
        """
        super().__init__(costs, table, start, goal, quadratic=quadratic, grid_path=grid_path)
        self._blocks = np.empty(3 * self.costs.size, dtype=np.int32)
        self._pending = np.zeros(self.costs.size, dtype=np.uint8)
        self._heuristic, self._full = heuristic, full
        distance = math.hypot(goal[0] - start[0], goal[1] - start[1])
        self._levels = np.array([threshold + heuristic * distance, rise], dtype=np.float64)
        seeds = self._seeds()
        for cell, potential in seeds.items():
            self.potential_with_rim[cell] = potential
        around = [n for cell in seeds for n in (cell + 1, cell - 1, cell - self.row, cell + self.row)]
        flat = self.costs.ravel()
        # Several seeds may improve each other; a single one cannot be improved.
        wait = [n for n in dict.fromkeys(around) if table[flat[n]] < HIGH and (n not in seeds or len(seeds) > 1)]
        self._blocks[: len(wait)] = wait
        self._pending[wait] = 1
        self._state = np.array([0, 1, 0, len(wait), 0, 0, 0], dtype=np.int64)

    def _seeds(self) -> dict[int, float]:
        """Return the first cells and their potentials."""
        return {self._index(cell_of(self.start)): 0.0}

    @property
    def expanded(self) -> int:
        """The number of expansions so far; cells that were expanded twice count twice."""
        return int(self._state[EXPANDED])

    def _expand(self, count: int) -> int:
        run = compiled_wave()
        return int(
            run(
                self.costs.ravel(),
                self.table,
                self.potential_with_rim,
                self._pending,
                self._blocks,
                self._state,
                self._levels,
                self.row,
                int(self.quadratic),
                -1 if self._full else self._stop,
                self._heuristic,
                count,
            )
        )


class NavfnSearch(WaveSearch):
    """The search of navfn; `potential` is the path cost to each cell, interpolated between its neighbours."""

    def __init__(
        self,
        costs: NDArray[np.uint8],
        start: Point,
        goal: Point,
        *,
        allow_unknown: bool = True,
        a_star: bool = False,
        full: bool = False,
        outline: bool = True,
    ) -> None:
        """Prepare a search by Dijkstra's algorithm or A*.

        With `full` it continues after reaching the goal. With `outline`, as in the original, the outermost cells are
        lethal.

        Raises `OutsideMap` if start or goal is outside the grid.
        """
        super().__init__(
            outlined(costs) if outline else costs,
            navfn_table(allow_unknown),
            start,
            goal,
            threshold=COST_OBS,
            rise=2 * COST_NEUTRAL,
            heuristic=COST_NEUTRAL if a_star else 0.0,
            full=full,
        )


COST_NEUTRAL = 50
"""navfn: cost of entering a free cell."""
COST_FACTOR = 0.8
"""navfn: factor of a cell's cost."""
COST_OBS = 254
"""navfn: lower bound of the costs of obstacles."""


def navfn_table(allow_unknown: bool) -> NDArray[np.float32]:
    """Return the cost of entering a cell by its cost value (256,): 50 + 0.8 cost up to 252, infinite above.

    Unknown cells (255) cost 253 if `allow_unknown`.
    """
    table = np.full(256, np.inf, dtype=np.float32)
    table[:253] = np.minimum(np.floor(COST_NEUTRAL + COST_FACTOR * np.arange(253)), COST_OBS - 1)
    if allow_unknown:
        table[NO_INFORMATION] = COST_OBS - 1
    return table


def outlined(costs: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return a copy of costs (h, w) whose outermost cells are lethal."""
    made = np.array(costs, dtype=np.uint8, order="C")
    made[[0, -1], :] = made[:, [0, -1]] = LETHAL_OBSTACLE
    return made


def cell_of(point: Point) -> tuple[int, int]:
    """Return the cell that contains a point (column, row)."""
    return math.floor(point[0] + 0.5), math.floor(point[1] + 0.5)


def _shown(point: Point) -> str:
    return f"({point[0]:g}, {point[1]:g})"
