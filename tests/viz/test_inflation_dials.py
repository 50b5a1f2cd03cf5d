"""Inflation with dials: what the picture says, and what the page gets."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d import Costmap2D
from rosmini.viz.inflation_dials import inflation_dials, runs
from rosmini.viz.view import ViewError


def room():
    costs = np.zeros((20, 30), dtype=np.uint8)
    costs[0], costs[10, 10], costs[:, 29] = 254, 254, 255
    costs[5, 5] = 100
    return Costmap2D.of(costs, 0.05)


def test_it_says_the_numbers_and_what_they_make():
    view = room().show_inflation(title="Figure 33.2: Turn it", inscribed_radius=0.1, inflation_radius=0.2)
    assert view.text == (
        "Figure 33.2: Turn it: 30 x 20 cells of 0.05 m\n"
        "inflation_radius 0.2 m, cost_scaling_factor 10, inscribed radius 0.1 m\n"
        "free 64 %, near something 16 %, inscribed 12 %, obstacle 5 %, unknown 3 %"
    )
    assert "inflation_radius 0.2 m" in view.alt


def test_what_is_not_an_obstacle_and_not_unknown_is_left_out():
    view = inflation_dials(room(), inflation_radius=0.0)
    assert set(np.unique(view.inflated.costs)) == {0, 254, 255}


@given(st.lists(st.sampled_from([0, 254, 255]), min_size=1, max_size=900))
def test_runs_hold_the_cells(cells):
    packed = runs(np.array(cells, dtype=np.uint8))
    unpacked = [cost for cost, count in zip(packed[::2], packed[1::2], strict=True) for _ in range(count)]
    assert unpacked == cells


def test_what_is_too_large_is_told():
    with pytest.raises(ViewError, match="500 x 10 cells: with dials, 400 a side"):
        inflation_dials(Costmap2D(500, 10, 0.05))
