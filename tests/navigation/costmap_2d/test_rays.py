"""Rays: the same cells as exact arithmetic gives, and no others."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d import rays
from rosmini.navigation.costmap_2d.rays import clear_rays, clip_end, line_cells

CELLS = st.integers(-40, 40)


def exact_line(x0, y0, x1, y1):
    """For each step along the longer axis the cell nearest to the line, in fractions; halves go on along the line."""
    dx, dy = x1 - x0, y1 - y0
    longer = max(abs(dx), abs(dy), 1)
    for step in range(max(abs(dx), abs(dy)) + 1):
        at = [Fraction(abs(d) * step, longer) for d in (dx, dy)]
        # Bresenham's error begins at half of the longer side, rounded down: of two equally near cells that decides.
        shift = Fraction(longer // 2, longer)
        cell = [math.floor(value + shift) if value.denominator > 1 else int(value) for value in at]
        yield x0 + cell[0] * (1 if dx >= 0 else -1), y0 + cell[1] * (1 if dy >= 0 else -1)


@given(CELLS, CELLS, CELLS, CELLS)
def test_a_line_is_the_cells_nearest_to_it(x0, y0, x1, y1):
    columns, rows = line_cells(x0, y0, x1, y1)
    found = list(zip(columns.tolist(), rows.tolist(), strict=True))
    assert found == list(exact_line(x0, y0, x1, y1))
    assert found[0] == (x0, y0)
    assert found[-1] == (x1, y1)


@given(
    st.tuples(st.floats(0.1, 1.9), st.floats(0.1, 1.9)),
    st.lists(st.tuples(st.floats(-3, 5), st.floats(-3, 5)), min_size=1, max_size=8),
    st.integers(0, 60),
    st.sampled_from([clear_rays, rays.compiled_clear_rays()]),
)
def test_a_ray_clears_the_cells_of_its_line_and_no_others(sensor, ends, reach, clear):
    costs = np.full((40, 40), 254, dtype=np.uint8)
    points = np.array([(x, y, 0.0) for x, y in ends])
    box = clear(costs, 0.0, 0.0, 0.05, *sensor, points, reach, 0)
    wanted = np.full_like(costs, 254)
    mx, my = (math.floor(value / 0.05) for value in sensor)
    for x, y in ends:
        end = [math.floor(value / 0.05) for value in clip_end(*sensor, x, y, 0.0, 0.0, 2.0, 2.0)]
        if not all(0 <= value < 40 for value in end):
            continue
        cells = list(exact_line(mx, my, *end))
        length = math.hypot(end[0] - mx, end[1] - my)
        count = len(cells) - 1 if length <= reach else int(reach / length * (len(cells) - 1))
        for column, row in cells[: count + 1]:
            wanted[row, column] = 0
    assert (costs == wanted).all()
    rows, columns = np.nonzero(costs == 0)
    if len(rows):
        assert box[0] <= columns.min() <= columns.max() <= box[2]
        assert box[1] <= rows.min() <= rows.max() <= box[3]


@pytest.mark.parametrize("end", [(math.nan, 1.0), (1.0, math.inf), (-math.inf, math.nan)])
def test_an_end_that_is_no_point_clears_nothing(end):
    costs = np.full((4, 4), 254, dtype=np.uint8)
    clear_rays(costs, 0.0, 0.0, 1.0, 0.5, 0.5, np.array([(*end, 0.0)]), 10, 0)
    assert (costs == 254).all()
