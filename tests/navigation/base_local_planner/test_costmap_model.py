"""What a footprint costs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.base_local_planner import rollout
from rosmini.navigation.base_local_planner.costmap_model import footprint_cells, footprint_cost, line_cells
from rosmini.navigation.base_local_planner.rollout import HIT, OUTSIDE, UNSEEN
from rosmini.navigation.costmap_2d.costmap import Costmap2D

SQUARE = [(-1, -1), (-1, 1), (1, 1), (1, -1)]
CELLS = st.integers(-20, 20)


def test_the_largest_cost_on_the_outline_counts_and_nothing_inside():
    grid = Costmap2D(9, 9, 1.0)
    grid.costs[4, 4], grid.costs[3, 5], grid.costs[1, 1] = 254, 77, 200
    assert footprint_cost(grid, (4.5, 4.5, 0.0), SQUARE) == 77
    grid.costs[3, 4] = 253
    assert footprint_cost(grid, (4.5, 4.5, 0.0), SQUARE) == 253


@pytest.mark.parametrize(("cost", "verdict"), [(254, HIT), (255, UNSEEN)])
def test_an_obstacle_or_the_unknown_under_the_outline_rejects(cost, verdict):
    grid = Costmap2D(9, 9, 1.0)
    grid.costs[5, 4] = cost
    assert footprint_cost(grid, (4.5, 4.5, 0.0), SQUARE) == verdict
    assert footprint_cost(grid, (4.5, 6.5, 0.0), SQUARE) == verdict
    assert footprint_cost(grid, (4.5, 2.5, 0.0), SQUARE) == 0


def test_a_turned_footprint_reaches_further():
    grid = Costmap2D(9, 9, 1.0)
    grid.costs[4, 6] = 254
    assert footprint_cost(grid, (4.5, 4.5, 0.0), SQUARE) == 0
    assert footprint_cost(grid, (4.5, 4.5, math.pi / 4), [(x * 1.2, y * 1.2) for x, y in SQUARE]) == HIT


def test_a_robot_without_an_outline_is_round():
    grid = Costmap2D(3, 3, 1.0)
    grid.costs[1] = (252, 253, 255)
    assert [footprint_cost(grid, (x + 0.5, 1.5, 0.0), []) for x in range(4)] == [252, HIT, UNSEEN, OUTSIDE]


def test_off_the_map_is_off_the_map_on_all_sides():
    grid = Costmap2D(4, 4, 1.0, (-2.0, -2.0))
    assert footprint_cost(grid, (0.0, 0.0, 0.0), SQUARE) == 0
    poses = [(1.5, 0), (-1.5, 0), (0, 1.5), (0, -1.5), (9, 9), (-9, -9)]
    assert {footprint_cost(grid, (x, y, 0.0), SQUARE) for x, y in poses} == {OUTSIDE}


@given(CELLS, CELLS, CELLS, CELLS)
def test_a_line_joins_its_ends_without_gaps(x, y, end_x, end_y):
    cells = line_cells(x, y, end_x, end_y)
    assert (cells[0], cells[-1]) == ((x, y), (end_x, end_y))
    steps = np.abs(np.diff(np.array(cells), axis=0))
    assert len(steps) == max(abs(end_x - x), abs(end_y - y))
    assert not len(steps) or set(steps.max(axis=1)) == {1}
    # never further than half a cell from the straight line
    length = math.hypot(end_x - x, end_y - y)
    off = [abs((end_x - x) * (my - y) - (end_y - y) * (mx - x)) for mx, my in cells]
    assert max(off) <= 0.5 * max(abs(end_x - x), abs(end_y - y)) + 1e-9 or length == 0


@given(st.integers(0, 2**32 - 1))
def test_the_kernel_visits_these_cells_and_no_others(seed):
    random = np.random.default_rng(seed)
    x, y, end_x, end_y = (int(value) for value in random.integers(0, 12, 4))
    costs = np.zeros((12, 12), dtype=np.uint8)
    for mx, my in line_cells(x, y, end_x, end_y)[:-1] or [(x, y)]:
        costs[my, mx] = random.integers(1, 253)
    expected = int(costs.max())
    costs[costs == 0] = 254
    assert rollout.line_cost(costs.reshape(-1), 12, x, y, end_x, end_y) == expected


def test_the_cells_under_a_footprint():
    grid = Costmap2D(9, 9, 1.0)
    outline = footprint_cells(grid, (4.5, 4.5, 0.0), SQUARE, fill=False)
    assert len(outline) == 8
    assert (4, 4) not in outline
    assert len(footprint_cells(grid, (4.5, 4.5, 0.0), SQUARE, fill=True)) == 9
    assert footprint_cells(grid, (4.5, 4.5, 0.0), [], fill=True) == [(4, 4)]
