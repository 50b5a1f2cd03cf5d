"""Convex polygons: their outline is that of the lines between their vertices, and what is inside is filled."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.navigation.costmap_2d.polygons import fill, outline_spans
from rosmini.navigation.costmap_2d.rays import line_cells

CELLS = st.tuples(st.integers(-30, 30), st.integers(-30, 30))


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
