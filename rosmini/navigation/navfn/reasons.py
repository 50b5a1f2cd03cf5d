"""The reason why a search found no path: what is blocked, how much is reachable, and the nearest reachable cell."""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.costmap_2d.costmap import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
    Costmap2D,
)
from rosmini.navigation.nav_core.failures import GoalBlocked, NoPath, PlanningFailure, StartBlocked

MEANING = {
    INSCRIBED_INFLATED_OBSTACLE: "nearer to an obstacle than the robot's inscribed radius",
    LETHAL_OBSTACLE: "an obstacle, or at the map's edge",
    NO_INFORMATION: "unknown",
}


class Searched(Protocol):
    """The attributes of a search that `failure` uses."""

    start: tuple[float, float]
    goal: tuple[float, float]
    goal_cost: int
    entering_goal: float

    @property
    def reached(self) -> NDArray[np.bool_]:
        """True for each cell (h, w) that has a potential."""


def failure(search: Searched, grid: Costmap2D | None = None) -> PlanningFailure:
    """Return the failure of a finished search that did not reach its goal; in metres if a grid is given.

    Its numbers are `start`, `goal`, `goal_cost`, `reachable` [cells], `nearest` (a reachable cell), and the `distance`
    from there to the goal (in cells, or metres if a grid is given).
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
