"""Inflation: each cell has what the formula gives for the exact distance to the nearest obstacle."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rosmini.navigation.costmap_2d.inflation import cell_distance, cost_at, cost_table, inflate, squared_distances
from rosmini.navigation.costmap_2d.layer import Window

GRIDS = st.tuples(st.integers(1, 24), st.integers(1, 24)).flatmap(
    lambda shape: arrays(np.uint8, shape, elements=st.sampled_from([0, 0, 0, 0, 0, 100, 253, 254, 255]))
)


def slowly(lethal, my, mx, radius):
    """The least squared distance by looking at every obstacle."""
    rows, columns = np.nonzero(lethal)
    least = min(((rows - my) ** 2 + (columns - mx) ** 2).tolist(), default=math.inf)
    return least if least <= radius * radius else radius * radius + 1


@given(GRIDS, st.integers(0, 14))
def test_distances_are_exact(grid, radius):
    lethal = grid == 254
    found = squared_distances(lethal, radius)
    for my, mx in np.ndindex(grid.shape):
        assert found[my, mx] == slowly(lethal, my, mx, radius)


@given(GRIDS, st.integers(0, 12), st.booleans(), st.floats(0.0, 0.4), st.floats(0.5, 20.0))
def test_each_cell_equals_the_formula(grid, radius, inflate_unknown, inscribed, scaling):
    height, width = grid.shape
    resolution = 0.05
    result = grid.copy()
    table = cost_table(radius, resolution, inscribed, scaling)
    inflate(result, Window(0, 0, width, height), radius, table, inflate_unknown=inflate_unknown)
    lethal = grid == 254
    for my, mx in np.ndindex(grid.shape):
        old, squared = grid[my, mx], slowly(lethal, my, mx, radius)
        cost = 0
        if radius and squared <= radius * radius:
            cost = cost_at(math.sqrt(squared) * resolution, inscribed, scaling)
        is_learnt = old == 255 and (cost >= 253 or (inflate_unknown and cost > 0))
        assert result[my, mx] == (cost if is_learnt else max(old, cost))


@given(GRIDS, st.integers(1, 12), st.data())
def test_a_window_has_what_the_whole_has(grid, radius, data):
    height, width = grid.shape
    x0, y0 = data.draw(st.integers(0, width)), data.draw(st.integers(0, height))
    window = Window(x0, y0, data.draw(st.integers(x0, width)), data.draw(st.integers(y0, height)))
    table = cost_table(radius, 0.05, 0.1, 10.0)
    whole, part = grid.copy(), grid.copy()
    inflate(whole, Window(0, 0, width, height), radius, table)
    inflate(part, window, radius, table)
    assert (window.view(part) == window.view(whole)).all()
    outside = np.ones(grid.shape, dtype=bool)
    window.view(outside)[...] = False
    assert (part[outside] == grid[outside]).all()


def test_the_numbers_of_a_burger():
    """Inscribed 0.105 m, the defaults 10 and 0.55 m: worked out by hand."""
    assert [cost_at(d, 0.105, 10.0) for d in (0.0, 0.05, 0.105, 0.15, 0.55)] == [254, 253, 253, 160, 2]
    assert 252 * math.exp(-10 * (0.15 - 0.105)) == pytest.approx(160.68, abs=0.01)


@pytest.mark.parametrize(("distance", "cells"), [(0.55, 11), (0.56, 12), (0.0, 0), (-1.0, 0), (0.01, 1)])
def test_a_radius_is_rounded_up_to_cells(distance, cells):
    assert cell_distance(distance, 0.05) == cells


def test_a_grid_that_is_computed_in_bands_is_the_same():
    rng = np.random.default_rng(3)
    costs = np.where(rng.random((700, 900)) < 0.002, 254, 0).astype(np.uint8)
    found = costs.copy()
    inflate(found, Window(0, 0, 900, 700), 11, cost_table(11, 0.05, 0.1, 10.0))
    squared = squared_distances(costs == 254, 11)
    assert (found == cost_table(11, 0.05, 0.1, 10.0)[squared]).all()
