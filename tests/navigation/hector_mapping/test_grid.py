"""One map: which cells change, by how much, and what they say then."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.hector_mapping.grid import OccupancyGrid, passed_cells

FREE, HIT = math.log(0.4 / 0.6), math.log(0.9 / 0.1)


def a_grid(**factors):
    return OccupancyGrid((40, 40), 0.1, (-2.0, -2.0), **factors)


def by_hand(first, last):
    """Bresenham's line in whole numbers, without its last cell."""
    (x, y), (dx, dy) = first, (last[0] - first[0], last[1] - first[1])
    long, short = max(abs(dx), abs(dy)), min(abs(dx), abs(dy))
    error, cells = long // 2, []
    for _ in range(long):
        cells.append((x, y))
        error += short
        over = error >= long
        error -= long * over
        if abs(dx) >= abs(dy):
            x, y = x + int(np.sign(dx)), y + int(np.sign(dy)) * over
        else:
            x, y = x + int(np.sign(dx)) * over, y + int(np.sign(dy))
    return cells


@given(st.lists(st.tuples(st.integers(-60, 60), st.integers(-60, 60)), min_size=1, max_size=8))
def test_lines_are_bresenhams(ends):
    first = (7, -4)
    ends = [end for end in ends if end != first] or [(8, -4)]
    columns, rows = passed_cells(np.array(first), np.array(ends))
    assert list(zip(columns.tolist(), rows.tolist(), strict=True)) == [c for end in ends for c in by_hand(first, end)]


def test_what_is_hit_is_not_passed_and_each_cell_changes_once():
    grid = a_grid()
    # The second beam passes the end of the first, the third ends with it.
    grid.update((0.0, 0.0), np.array([[0.5, 0.0], [1.0, 0.0], [0.52, 0.01]]))
    row = grid.odds[20]
    assert row[20:25] == pytest.approx([FREE] * 5)
    assert row[25] == pytest.approx(HIT)
    assert row[26:30] == pytest.approx([FREE] * 4)
    assert row[30] == pytest.approx(HIT)
    assert np.count_nonzero(grid.odds) == 11
    assert grid.probabilities[20, 25] == pytest.approx(0.9)
    assert grid.probabilities[20, 22] == pytest.approx(0.4)
    shown = grid.as_map()
    assert (shown.occupancy[20, 25], shown.occupancy[20, 22], shown.occupancy[0, 0]) == (100, 0, -1)
    assert shown.world_to_map(0.5, 0.0) == (25, 20)
    assert shown.origin == pytest.approx((-2.05, -2.05, 0.0)), "the middle of cell (0, 0) is at -2"


def test_odds_over_a_long_time():
    """Upwards they end above 50, downwards never; probabilities stay numbers, without a warning."""
    grid = a_grid()
    with np.errstate(all="raise"):
        for _ in range(2500):
            grid.update((0.0, 0.0), np.array([[0.5, 0.0]]))
    assert 50 <= grid.odds[20, 25] < 53
    assert grid.odds[20, 22] == pytest.approx(2500 * FREE, rel=1e-3)
    assert grid.probabilities[20, 25] == 1.0
    assert 0 <= grid.probabilities[20, 22] < 1e-30
