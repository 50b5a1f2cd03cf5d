"""A search that the reader of the book wrote, displayed and stepped like those of the planners."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.navigation.costmap_2d.costmap import LETHAL_OBSTACLE

from .search import Point, Points, Search, cell_of
from .wave import HIGH

Cell = tuple[int, int]

GREY = 30
"""Increase of the displayed cost for each unit of price above 1."""
DARKEST = 252


class HandSearch(Search):
    """The recorded steps of a search that the reader of the book wrote.

    Args:
        price: the cost of entering each cell (column, row); cells that are missing are walls.
        start: the first cell.
        goal: the goal's cell.
        taken: the cells in the order of their expansion.
        cost: the path cost of each cell that was reached.
        parent: the predecessor of each cell that was reached, except the start.

    Raises:
        OutsideMap: start or goal is outside the grid.
        RosminiError: a cell in `taken` or `cost` lacks a price, a cost or a parent; the message names the cell.

    """

    def __init__(
        self,
        price: Mapping[Cell, float],
        start: Cell,
        goal: Cell,
        taken: Sequence[Cell],
        cost: Mapping[Cell, float],
        parent: Mapping[Cell, Cell],
    ) -> None:
        cells = np.array(list(price), dtype=np.int64)
        costs = np.full(cells.max(axis=0)[::-1] + 1, LETHAL_OBSTACLE, dtype=np.uint8)
        costs[cells[:, 1], cells[:, 0]] = [min(DARKEST, int(GREY * (each - 1))) for each in price.values()]
        table = np.ones(256, dtype=np.float32)
        table[LETHAL_OBSTACLE] = np.inf
        super().__init__(costs, table, start, goal, grid_path=True)
        for cell in (*cost, *taken):
            if cell not in price or cell not in cost or (cell != start and cell not in parent):
                raise RosminiError(
                    f"the cell {cell} of a search by hand must be in `price` and have a cost and, unless it "
                    f"is the start {start}, a parent"
                )
        self._taken, self._cost, self._parent = list(taken), cost, parent
        self._done = 0
        self._children: dict[Cell, list[Cell]] = {}
        for child, each in parent.items():
            self._children.setdefault(each, []).append(child)
        self.potential_with_rim[self._index(start)] = 0

    @property
    def expanded(self) -> int:
        """The number of cells expanded so far."""
        return self._done

    def path_to(self, goal: Point) -> Points:
        """Return the path along the parents (n, 2), in columns and rows.

        Raises a `PlanningFailure` if the goal was not reached, or `RosminiError` if the parents form a loop.
        """
        if self.potential_at(cell_of(goal)) >= HIGH:
            raise self.failure()
        points = [cell_of(goal)]
        while points[-1] != self.start:
            points.append(self._parent[points[-1]])
            if len(points) > len(self._cost):
                raise RosminiError(f"the parents of a search by hand form a loop, at {points[-1]}")
        return np.array(points[::-1], dtype=np.float64)

    def _expand(self, count: int) -> int:
        for cell in self._taken[self._done : self._done + count]:
            for child in self._children.get(cell, ()):
                self.potential_with_rim[self._index(child)] = self._cost[child]
        self._done = min(self._done + count, len(self._taken))
        if self._done < len(self._taken):
            return 0
        return 1 if self.goal in self._taken else 2

    def _waiting(self) -> NDArray[np.int32]:
        done = {self._index(cell) for cell in self._taken[: self._done]}
        reached = np.flatnonzero(self.potential_with_rim < HIGH).tolist()
        return np.array([n for n in reached if n not in done], dtype=np.int32)
