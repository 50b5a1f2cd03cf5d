"""Grids to plan on, and second opinions on what planners make of them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import strategies as st

from rosmini.navigation.navfn.wave import HIGH


@st.composite
def grids(draw, largest: int = 14):
    """Costs of a random grid, and two different cells of it that are free."""
    height, width = draw(st.integers(3, largest)), draw(st.integers(3, largest))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    costs = rng.integers(0, 253, (height, width)).astype(np.uint8)
    costs[rng.random(costs.shape) < draw(st.sampled_from([0.0, 0.2, 0.5]))] = 0
    blocked = rng.random(costs.shape) < draw(st.sampled_from([0.0, 0.1, 0.3, 0.45]))
    costs[blocked] = rng.choice([253, 254, 255], blocked.sum())
    picked = rng.choice(costs.size, 2, replace=False)
    start, goal = ((int(n % width), int(n // width)) for n in picked)
    costs[start[1], start[0]] = costs[goal[1], goal[0]] = 0
    return costs, start, goal


def shortest(entering: np.ndarray, seeds: dict[tuple[int, int], float]) -> np.ndarray:
    """What it costs to get to each cell over sides of cells, by scipy; `entering` (h, w), infinite if blocked."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    number = np.arange(entering.size).reshape(entering.shape)
    pairs = [
        (number[:, :-1], number[:, 1:]),
        (number[:, 1:], number[:, :-1]),
        (number[:-1], number[1:]),
        (number[1:], number[:-1]),
    ]
    begin = np.concatenate([a.ravel() for a, _ in pairs])
    end = np.concatenate([b.ravel() for _, b in pairs])
    weight = entering.ravel()[end]
    # One further node, from which the seeds are reached; scipy takes a weight of 0 for no edge.
    begin = np.concatenate([begin, np.full(len(seeds), entering.size)])
    end = np.concatenate([end, [number[row, column] for column, row in seeds]]).astype(int)
    weight = np.concatenate([weight, np.array(list(seeds.values())) + 1.0])
    fine = np.isfinite(weight)
    graph = coo_array((weight[fine], (begin[fine], end[fine])), shape=(entering.size + 1,) * 2).tocsr()
    found = dijkstra(graph, indices=entering.size)[:-1] - 1.0
    return np.where(np.isfinite(found), found, HIGH).reshape(entering.shape)


def fixed_point(entering: np.ndarray, seeds: dict[tuple[int, int], float]) -> np.ndarray:
    """The fixed point of the interpolated update, from above: all cells at once, in doubles, until nothing changes.

    The formula jumps down by 0.5 % of a cell's cost where it leaves the second neighbour out; without that jump, as
    here, there is one fixed point, and no order of updates gets below it.
    """
    potential = np.full(entering.shape, HIGH)
    for (column, row), value in seeds.items():
        potential[row, column] = value
    free = np.isfinite(entering)
    cost = np.where(free, entering, 1.0)
    while True:
        rim = np.pad(potential, 1, constant_values=HIGH)
        a = np.minimum(rim[1:-1, :-2], rim[1:-1, 2:])
        b = np.minimum(rim[:-2, 1:-1], rim[2:, 1:-1])
        low, share = np.minimum(a, b), np.minimum(np.abs(a - b) / cost, 1.0)
        step = np.minimum(-0.2301 * share**2 + 0.5307 * share + 0.7040, 1.0)
        better = np.where(free & (low < HIGH), low + cost * step, HIGH)
        better = np.minimum(better, potential)
        if np.array_equal(better, potential):
            return potential
        potential = better


def crossed(path: np.ndarray) -> set[tuple[int, int]]:
    """The cells (column, row) whose inside a path (n, 2) passes through."""
    cells = set()
    for a, b in pairwise(path):
        steps = max(2, int(200 * np.hypot(*(b - a))))
        shares = (np.arange(steps) + 0.5)[:, None] / steps
        points = a + (b - a) * shares
        inside = np.all(np.abs(points + 0.5 - np.round(points + 0.5)) > 1e-6, axis=1)
        cells |= set(map(tuple, np.floor(points[inside] + 0.5).astype(int).tolist()))
    return cells
