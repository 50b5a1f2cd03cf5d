"""Costs of frontiers by explore_lite's formula."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.navigation.costmap_2d.costmap import Costmap2D
from rosmini.navigation.explore_lite.costs import Weights, ranked
from rosmini.navigation.frontier_exploration.search import find_frontiers

# Free in the middle, unknown left (2 cells, near) and right (8 cells, far).
MAP = np.full((8, 40), 254, dtype=np.uint8)
MAP[:, 5:30] = 0
MAP[3:5, 4] = 255
MAP[:, 30] = 255


def choice(weights, resolution=0.05):
    grid = Costmap2D.of(MAP, resolution)
    found = ranked(find_frontiers(grid, 6.5 * resolution, 3.5 * resolution), weights, resolution)
    return [(round(cost, 4), one.size) for cost, one in found]


def test_by_hand():
    # Left: 2 cells, 2 cells away = 0.1 m: 3 * 0.1 * 0.05 - 1 * 2 * 0.05 = -0.085.
    # Right: 8 cells, 24 cells away = 1.2 m: 3 * 1.2 * 0.05 - 8 * 0.05 = -0.22, and so it is first.
    assert choice(Weights(3.0, 1.0, 0.0)) == [(-0.22, 8), (-0.085, 2)]


def test_the_way_may_weigh_more():
    assert choice(Weights(10.0, 1.0, 0.0)) == [(-0.05, 2), (0.2, 8)]


@pytest.mark.parametrize(("least", "sizes"), [(0.1, [8, 2]), (0.11, [8]), (0.41, [])])
def test_small_ones_are_left_out(least, sizes):
    assert [size for _, size in choice(Weights(3.0, 1.0, least))] == sizes
