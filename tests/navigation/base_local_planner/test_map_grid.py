"""Distances from the plan."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import lil_matrix
from scipy.sparse.csgraph import dijkstra

from rosmini.navigation.base_local_planner.map_grid import MapGrid, densified, grid_from, plan_cells
from rosmini.navigation.costmap_2d.costmap import Costmap2D


def goal_grid(grid: Costmap2D, plan) -> MapGrid:
    return grid_from(grid, plan_cells(grid, plan)[-1:])


def reference(costs, targets, within=()):
    """The same distances from scipy: edges into cells that are free."""
    height, width = costs.shape
    edges = lil_matrix((height * width, height * width))
    free = costs < 253
    for mx, my in within:
        free[my, mx] = True
    for my in range(height):
        for mx in range(width):
            for x, y in ((mx + 1, my), (mx - 1, my), (mx, my + 1), (mx, my - 1)):
                if 0 <= x < width and 0 <= y < height and free[y, x]:
                    edges[my * width + mx, y * width + x] = 1
    starts = [my * width + mx for mx, my in targets]
    return dijkstra(edges.tocsr(), indices=starts, unweighted=True, min_only=True).reshape(height, width)


@given(st.integers(0, 2**32 - 1))
def test_the_wavefront_is_the_shortest_way_round_obstacles(seed):
    random = np.random.default_rng(seed)
    height, width = random.integers(2, 12, 2)
    costs = random.choice([0, 100, 253, 254, 255], (height, width), p=[0.5, 0.2, 0.1, 0.1, 0.1])
    grid = Costmap2D.of(costs)
    plan = random.uniform(0, (width, height), (3, 2))
    within = random.integers(0, (width, height), (2, 2))
    found = grid_from(grid, plan_cells(grid, plan), within)
    expected = reference(costs, found.targets.tolist(), within.tolist()) if len(found.targets) else None
    for my in range(height):
        for mx in range(width):
            value = found.distances[my, mx]
            if expected is not None and np.isfinite(expected[my, mx]):
                assert value == expected[my, mx]
            else:
                beside = [
                    found.distances[y, x] < found.obstacle
                    for x, y in ((mx + 1, my), (mx - 1, my), (mx, my + 1), (mx, my - 1))
                    if 0 <= x < width and 0 <= y < height
                ]
                blocked = costs[my, mx] >= 253 and [mx, my] not in within.tolist()
                assert value == (found.obstacle if blocked and any(beside) else found.unreachable)


def test_a_plan_of_few_points_is_filled_up_so_that_no_cell_is_left_out():
    points = densified(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.3]]), 0.25)
    assert points.tolist() == [[0, 0], [0.25, 0], [0.5, 0], [0.75, 0], [1, 0], [1, 0.15], [1, 0.3]]


def test_only_the_first_part_on_the_map_counts():
    grid = Costmap2D(5, 5, 1.0)
    plan = np.array([[-2.0, 2.5], [7.0, 2.5], [7.0, 0.5], [0.5, 0.5]])
    assert plan_cells(grid, plan)[[0, -1]].tolist() == [[0, 2], [4, 2]]
    assert goal_grid(grid, plan).distances[0].tolist() == [6, 5, 4, 3, 2]
    grid.costs[2, 3] = 255
    assert goal_grid(grid, plan).targets.tolist() == [[2, 2]]


def test_a_plan_that_is_elsewhere_reaches_nothing():
    costmap = Costmap2D(5, 4, 1.0)
    grid = grid_from(costmap, plan_cells(costmap, np.array([[9.0, 9.0]])))
    assert (grid.obstacle, grid.unreachable) == (20, 21)
    assert set(grid.distances.ravel().tolist()) == {21}
