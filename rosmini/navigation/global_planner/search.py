"""The searches of global_planner: Dijkstra with navfn's wave, and A* (http://wiki.ros.org/global_planner).

Points may lie between cell centres (`precise`): Dijkstra then starts in the free cells around the start, each with the
cost of the distance to its centre. The original also starts in obstacles, and sets the potential of two neighbours to 0
if the start is a cell centre. A cell of cost 252 is passable here, although the original's Dijkstra treats it as
lethal: `lethal_cost` is the lowest lethal cost.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import NO_INFORMATION
from rosmini.navigation.navfn.search import Point, Search, WaveSearch, cell_of, outlined
from rosmini.navigation.navfn.wave import HIGH, interpolated

from .best_first import compiled_best_first

LETHAL_COST = 253
NEUTRAL_COST = 50
COST_FACTOR = 3.0

FILL_DISTANCE = 2
"""Distance [cells] around a reached goal within which cells get a potential, for the gradient."""


def dijkstra_table(
    allow_unknown: bool,
    lethal_cost: int = LETHAL_COST,
    neutral_cost: int = NEUTRAL_COST,
    cost_factor: float = COST_FACTOR,
) -> NDArray[np.float32]:
    """Return Dijkstra's cost of entering a cell by cost value [256]: neutral + factor * cost, below lethal."""
    costs = np.arange(256, dtype=np.float32)
    table = np.minimum(costs * np.float32(cost_factor) + neutral_cost, lethal_cost - 1)
    table[~_passable(allow_unknown, lethal_cost)] = np.inf
    return np.asarray(np.maximum(table, 1), dtype=np.float32)


def a_star_table(
    allow_unknown: bool, lethal_cost: int = LETHAL_COST, neutral_cost: int = NEUTRAL_COST
) -> NDArray[np.float32]:
    """Return A*'s cost of entering a cell by cost value [256]: cost + neutral, without `cost_factor`, as in ROS."""
    table = np.arange(256, dtype=np.float32) + neutral_cost
    table[~_passable(allow_unknown, lethal_cost)] = np.inf
    return table


def _passable(allow_unknown: bool, lethal_cost: int) -> NDArray[np.bool_]:
    passable = np.asarray(np.arange(256) < lethal_cost)
    passable[NO_INFORMATION] = allow_unknown
    return passable


def _fill_around_goal(search: Search, goal: tuple[int, int]) -> None:
    """Give a potential to those passable cells around a reached goal that have none but a neighbour with one."""
    flat, table, row = search.potential_with_rim, search.table, search.row
    costs = search.costs.ravel()
    for y in range(max(0, goal[1] - FILL_DISTANCE), min(search.height, goal[1] + FILL_DISTANCE + 1)):
        for x in range(max(0, goal[0] - FILL_DISTANCE), min(search.width, goal[0] + FILL_DISTANCE + 1)):
            n = (y + 1) * row + x + 1
            a, b = min(flat[n - 1], flat[n + 1]), min(flat[n - row], flat[n + row])
            cost = float(table[costs[n]])
            if flat[n] >= HIGH and cost < HIGH and min(a, b) < HIGH:
                flat[n] = interpolated(float(a), float(b), cost) if search.quadratic else min(a, b) + cost


class GlobalDijkstra(WaveSearch):
    """The Dijkstra search of global_planner; the wave spreads from the start."""

    def __init__(
        self,
        costs: NDArray[np.uint8],
        start: Point,
        goal: Point,
        *,
        allow_unknown: bool = True,
        quadratic: bool = True,
        grid_path: bool = False,
        precise: bool = True,
        outline: bool = True,
        full: bool = False,
        lethal_cost: int = LETHAL_COST,
        neutral_cost: int = NEUTRAL_COST,
        cost_factor: float = COST_FACTOR,
    ) -> None:
        """Prepare the search. Raises `OutsideMap` if start or goal is outside the grid."""
        self.precise, self.neutral_cost = precise, neutral_cost
        super().__init__(
            outlined(costs) if outline else costs,
            dijkstra_table(allow_unknown, lethal_cost, neutral_cost, cost_factor),
            start,
            goal,
            threshold=lethal_cost,
            rise=2 * neutral_cost,
            full=full,
            quadratic=quadratic,
            grid_path=grid_path,
        )

    def _seeds(self) -> dict[int, float]:
        if not self.precise:
            return super()._seeds()
        x, y = self.start
        own_x, own_y = cell_of(self.start)
        next_x, next_y = math.floor(x) + math.ceil(x) - own_x, math.floor(y) + math.ceil(y) - own_y
        cells = {(own_x, own_y)} | {c for c in ((next_x, own_y), (own_x, next_y)) if self._free(*c)}
        # The diagonal cell counts only if it can be reached through one of the two cells beside the start's cell.
        if len(cells) > 1 and self._free(next_x, next_y):
            cells.add((next_x, next_y))
        return {
            self._index((column, row)): self.neutral_cost * math.hypot(column - x, row - y)
            for column, row in sorted(cells)
        }

    def _free(self, column: int, row: int) -> bool:
        return bool(self.table[self.costs[row + 1, column + 1]] < HIGH)

    def _expand(self, count: int) -> int:
        result = super()._expand(count)
        if result == 1 and self.precise:
            _fill_around_goal(self, cell_of(self.goal))
        return result


class GlobalAStar(Search):
    """The A* search of global_planner."""

    def __init__(
        self,
        costs: NDArray[np.uint8],
        start: Point,
        goal: Point,
        *,
        allow_unknown: bool = True,
        quadratic: bool = True,
        grid_path: bool = False,
        precise: bool = True,
        outline: bool = True,
        lethal_cost: int = LETHAL_COST,
        neutral_cost: int = NEUTRAL_COST,
    ) -> None:
        """Prepare the search. Raises `OutsideMap` if start or goal is outside the grid."""
        self.precise, self.neutral_cost = precise, neutral_cost
        table = a_star_table(allow_unknown, lethal_cost, neutral_cost)
        costs = outlined(costs) if outline else costs
        super().__init__(costs, table, start, goal, quadratic=quadratic, grid_path=grid_path)
        self._heap = np.empty(self.costs.size, dtype=np.int32)
        self._ranks = np.empty(self.costs.size, dtype=np.float32)
        self._heap[0] = self._index(cell_of(start))
        self._ranks[0] = 0
        self.potential_with_rim[self._heap[0]] = 0
        self._state = np.array([1, 0], dtype=np.int64)

    @property
    def expanded(self) -> int:
        """The number of cells taken from the heap."""
        return int(self._state[1])

    def _expand(self, count: int) -> int:
        run = compiled_best_first()
        result = int(
            run(
                self.costs.ravel(),
                self.table,
                self.potential_with_rim,
                self._heap,
                self._ranks,
                self._state,
                self.row,
                int(self.quadratic),
                self._stop,
                self.neutral_cost,
                count,
            )
        )
        if result == 1 and self.precise:
            _fill_around_goal(self, cell_of(self.goal))
        return result
