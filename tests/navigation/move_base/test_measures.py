import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d import LETHAL_OBSTACLE, Costmap2D
from rosmini.navigation.move_base.measures import clearance, narrowest

SQUARE = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]


def grid(*cells):
    made = Costmap2D(100, 100, 0.05, (0.0, 0.0))
    for mx, my in cells:
        made.costs[my, mx] = LETHAL_OBSTACLE
    return made


def test_clearance_is_from_the_outline_to_the_middle_of_a_cell():
    assert clearance(grid((60, 50)), (2.525, 2.525, 0.0), SQUARE) == pytest.approx(0.4)
    assert clearance(grid((60, 50)), (2.525, 2.525, math.pi / 4), SQUARE) == pytest.approx(0.5 - 0.1 * math.sqrt(2))
    assert clearance(grid((51, 50)), (2.525, 2.525, 0.0), SQUARE) == 0.0, "inside"
    assert clearance(grid((90, 90)), (2.525, 2.525, 0.0), SQUARE) is None
    assert clearance(grid((60, 50)), (2.525, 2.525, 0.0), []) is None


@given(st.floats(0.5, 4.5), st.floats(0.5, 4.5), st.floats(-4, 4))
def test_clearance_lies_between_the_radii(x, y, yaw):
    there = grid((50, 50))
    away = math.dist((x, y), (2.525, 2.525))
    found = clearance(there, (x, y, yaw), SQUARE, reach=5.0)
    assert away - 0.1 * math.sqrt(2) - 1e-9 <= found <= max(0.0, away - 0.1) + 1e-9


def test_the_narrowest_place():
    path = np.stack([np.linspace(0.5, 4.5, 81), np.full(81, 2.525)], axis=-1)
    x, _, away = narrowest(grid((50, 56), (30, 40)), path)
    assert (x, away) == pytest.approx((2.525, 0.3), abs=0.03)
    assert narrowest(grid(), path) is None
