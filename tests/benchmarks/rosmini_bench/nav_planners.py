"""Global planners: their speed beside scipy's csgraph and scikit-image's MCP in the same run, and how it grows.

Worlds are squares with obstacles of random sizes, always as dense, inflated as costmap_2d does; the map of the depot is
`ROSMINI_DEPOT`'s, a YAML file. Times are CPU times in ms; searches are made anew each time.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.maps import load_map
from rosmini.navigation.global_planner.search import GlobalAStar, GlobalDijkstra
from rosmini.navigation.navfn.search import NavfnSearch, Search, navfn_table

from . import Measure
from .sim_growth import exponent

Costs = NDArray[np.uint8]
Problem = tuple[Costs, tuple[int, int], tuple[int, int]]

INSCRIBED, RADIUS, SCALING, RESOLUTION = 0.105, 0.55, 10.0, 0.05
"""The inflation [m, m, 1/m, m]: TurtleBot3's, as in the figures of the originals."""
SIDES = (200, 400, 800, 1600)
PLANNERS: dict[str, Callable[[Problem], Search]] = {
    "navfn full": lambda problem: NavfnSearch(*problem, full=True),
    "navfn A*": lambda problem: NavfnSearch(*problem, a_star=True),
    "global_planner Dijkstra": lambda problem: GlobalDijkstra(*problem, full=True),
    "global_planner plain": lambda problem: GlobalDijkstra(*problem, full=True, quadratic=False),
    "global_planner A*": lambda problem: GlobalAStar(*problem),
}
"""Each way to search, by name."""


def inflated(occupied: NDArray[np.bool_]) -> Costs:
    """The costs that inflation makes of obstacles, by exact distances."""
    from scipy.ndimage import distance_transform_edt

    away = distance_transform_edt(~occupied) * RESOLUTION
    costs = np.where(away <= RADIUS, 252 * np.exp(-SCALING * (away - INSCRIBED)), 0)
    costs[away <= INSCRIBED] = 253
    costs[occupied] = 254
    return costs.astype(np.uint8)


@cache
def world(side: int, seed: int = 1) -> Problem:
    """A square world of so many cells, with the start in one corner and the goal in the opposite one."""
    rng = np.random.default_rng(seed)
    occupied = np.zeros((side, side), dtype=bool)
    for _ in range(side * side // 2000):
        x, y = rng.integers(0, side, 2)
        width, height = rng.integers(3, 13, 2)
        occupied[y : y + height, x : x + width] = True
    occupied[:20, :20] = occupied[-20:, -20:] = False
    return inflated(occupied), (5, 5), (side - 6, side - 6)


@cache
def depot() -> Problem | None:
    """The map of the depot, and the two free cells that are farthest apart along its diagonal; None without it."""
    path = Path(os.environ.get("ROSMINI_DEPOT", ""))
    if not path.is_file():
        return None
    grid = load_map(path)
    costs = inflated(grid.occupancy == 100)
    costs[(grid.occupancy == -1) & (costs < 253)] = 255
    free = np.argwhere((costs == 0) & (grid.occupancy == 0))
    along = free @ np.array([1.0, 1.0])
    start, goal = (tuple(int(n) for n in free[i][::-1]) for i in (along.argmin(), along.argmax()))
    return costs, (start[0], start[1]), (goal[0], goal[1])


def search_time(make: Callable[[Problem], Search], problem: Problem, repeats: int = 3) -> float:
    """The milliseconds of a search, its arrays included: the least of a few."""
    best = math.inf
    for _ in range(repeats):
        begin = time.process_time()
        make(problem).expand()
        best = min(best, time.process_time() - begin)
    return best * 1e3


def plan_time(make: Callable[[Problem], Search], problem: Problem) -> float:
    """The same with the path."""
    begin = time.process_time()
    make(problem).path()
    return (time.process_time() - begin) * 1e3


def graph_of(problem: Problem) -> tuple[Any, int]:
    """The cells as scipy's sparse graph, joined over their sides, and the number of the start."""
    from scipy.sparse import coo_array

    costs, start, _ = problem
    entering = navfn_table(allow_unknown=True)[costs].astype(float)
    number = np.arange(costs.size).reshape(costs.shape)
    pairs = [(number[:, :-1], number[:, 1:]), (number[:-1], number[1:])]
    begin = np.concatenate([each[i].ravel() for i in (0, 1) for each in pairs])
    end = np.concatenate([each[1 - i].ravel() for i in (0, 1) for each in pairs])
    weight = entering.ravel()[end]
    fine = np.isfinite(weight) & np.isfinite(entering.ravel()[begin])
    graph = coo_array((weight[fine], (begin[fine], end[fine])), shape=(costs.size,) * 2).tocsr()
    return graph, int(number[start[1], start[0]])


def csgraph_time(problem: Problem) -> float:
    """The milliseconds of scipy's Dijkstra; making the graph is not counted."""
    from scipy.sparse.csgraph import dijkstra

    graph, start = graph_of(problem)
    begin = time.process_time()
    dijkstra(graph, indices=start)
    return (time.process_time() - begin) * 1e3


def skimage_time(problem: Problem) -> float:
    """The milliseconds of scikit-image's MCP_Geometric: all costs from the start. Raises `ImportError` without it."""
    from skimage.graph import MCP_Geometric

    costs, start, _ = problem
    entering = np.where(costs < 253, navfn_table(allow_unknown=True)[costs], -1.0)
    begin = time.process_time()
    MCP_Geometric(entering).find_costs([start[::-1]])
    return (time.process_time() - begin) * 1e3


def has_skimage() -> bool:
    """Whether scikit-image is installed."""
    try:
        import skimage.graph  # noqa: F401
    except ImportError:
        return False
    return True


def measures(sides: tuple[int, ...] = (400,)) -> Iterator[Measure]:
    """Each planner on each world, beside scipy; the full potential beside scikit-image, too."""
    for side in sides:
        yield from _of_problem(f"{side}^2", world(side))
    problem = depot()
    if problem is not None:
        yield from _of_problem("depot", problem)


def _of_problem(name: str, problem: Problem) -> Iterator[Measure]:
    for label, make in PLANNERS.items():
        ours, peer = partial(search_time, make, problem), partial(csgraph_time, problem)
        full = "A*" not in label
        yield Measure(f"{label}, {name}", "ms", ours, peer if full else None, "csgraph", more_is_better=False)
        if label == "navfn full" and has_skimage():
            beside = partial(skimage_time, problem)
            yield Measure(f"{label}, {name}", "ms", ours, beside, "scikit-image", more_is_better=False)
    navfn: Callable[[Problem], Search] = to_goal
    yield Measure(f"navfn plan, {name}", "ms", partial(plan_time, navfn, problem), more_is_better=False)


def to_goal(problem: Problem) -> Search:
    """What `navfn/NavfnROS` runs: until the goal is reached."""
    return NavfnSearch(*problem)


def growth(sides: tuple[int, ...] = SIDES) -> dict[str, tuple[list[float], float]]:
    """Each planner's times [ms] over the sides, and with which power of the side they grow (2: as the cells do)."""
    found = {}
    for label, make in PLANNERS.items():
        times = [search_time(make, world(side)) for side in sides]
        found[label] = times, exponent(sides, times)
    return found
