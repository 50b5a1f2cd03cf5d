"""The grid of costs: cells and metres, and a window that moves over its lattice."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d.costmap import NO_INFORMATION, Costmap2D, CostmapError, fill, outline_spans
from rosmini.navigation.costmap_2d.rays import line_cells

CELLS = st.tuples(st.integers(-30, 30), st.integers(-30, 30))


def numbered() -> Costmap2D:
    return Costmap2D.of(np.arange(12).reshape(3, 4), 0.5, (-1.0, 2.0))


def test_cells_are_named_column_first_from_the_lower_left_corner():
    grid = numbered()
    assert (grid.width, grid.height, grid.size_m) == (4, 3, (2.0, 1.5))
    assert grid.cost(1, 2) == grid.costs[2, 1] == 9
    assert grid.world_to_map(-1.0, 2.0) == (0, 0)
    assert grid.map_to_world(0, 0) == (-0.75, 2.25)
    assert grid.world_to_map(0.99, 3.49) == (3, 2)


@pytest.mark.parametrize("point", [(-1.01, 2.0), (1.0, 2.0), (0.0, 1.99), (0.0, 3.5)])
def test_outside_is_no_cell(point):
    grid = numbered()
    assert grid.world_to_map(*point) is None
    mx, my = grid.world_to_map_clamped(*point)
    assert grid.cost(mx, my) in grid.costs
    with pytest.raises(IndexError, match="outside a costmap of 4 x 3 cells"):
        grid.cost(*grid.world_to_map_no_bounds(*point))


@given(st.integers(0, 3), st.integers(0, 2))
def test_the_middle_of_a_cell_lies_in_it(mx, my):
    assert numbered().world_to_map(*numbered().map_to_world(mx, my)) == (mx, my)


@given(st.integers(-6, 6), st.integers(-6, 6), st.floats(0.001, 0.499), st.floats(0.001, 0.499))
def test_what_stays_in_the_window_keeps_its_cost_and_its_place(dx, dy, more_x, more_y):
    grid, before = numbered(), numbered()
    grid.default = NO_INFORMATION
    assert grid.move_origin(-1.0 + dx * 0.5 + more_x, 2.0 + dy * 0.5 + more_y) == (dx, dy)
    assert grid.costs.shape == before.costs.shape
    for my in range(3):
        for mx in range(4):
            there = before.world_to_map(*grid.map_to_world(mx, my))
            assert grid.cost(mx, my) == (NO_INFORMATION if there is None else before.cost(*there))


@pytest.mark.parametrize(
    ("numbers", "said"),
    [
        ((3, 3, 0.0), "the resolution is 0.0"),
        ((3, 3, math.nan), "the resolution is nan"),
        ((-1, 3, 1.0), "a costmap of -1 x 3 cells"),
        ((100_000, 100_000, 1.0), "at most 100,000,000"),
        ((3, 3, 1.0, (math.inf, 0.0)), "the origin of a costmap is"),
    ],
)
def test_numbers_that_make_no_grid_are_refused(numbers, said):
    with pytest.raises(CostmapError, match=said):
        Costmap2D(*numbers)


def test_costs_have_to_be_a_table():
    with pytest.raises(CostmapError, match=r"the shape \(3,\)"):
        Costmap2D.of([1, 2, 3])


@given(st.lists(CELLS, min_size=1, max_size=6))
def test_the_outline_is_that_of_the_lines(cells):
    columns: dict[int, list[int]] = {}
    for (x0, y0), (x1, y1) in zip(cells, [*cells[1:], *cells[:1]], strict=True):
        for x, y in zip(*(each.tolist() for each in line_cells(x0, y0, x1, y1)), strict=True):
            columns.setdefault(x, []).append(y)
    assert outline_spans(cells) == {x: (min(ys), max(ys)) for x, ys in columns.items()}


@given(st.floats(0.2, 1.8), st.floats(0.0, 7.0), st.integers(3, 12))
def test_what_is_inside_is_filled(radius, turn, count):
    grid = Costmap2D(80, 80, 0.05, (-2.0, -2.0))
    angles = turn + np.arange(count) * math.tau / count
    polygon = np.stack([radius * np.cos(angles), radius * np.sin(angles)], axis=-1)
    assert fill(grid, polygon, 254)
    away = np.hypot(*np.meshgrid(*[-2.0 + 0.05 * (np.arange(80) + 0.5)] * 2))
    inner = radius * math.cos(math.pi / count)
    assert (grid.costs[away < inner - 0.1] == 254).all()
    assert not grid.costs[away > radius + 0.1].any()


def test_a_vertex_outside_changes_nothing():
    grid = Costmap2D(10, 10, 0.1)
    assert not fill(grid, [(0.5, 0.5), (2.0, 0.5), (0.5, 0.8)], 254)
    assert not fill(grid, np.zeros((0, 2)), 254)
    assert not grid.costs.any()
