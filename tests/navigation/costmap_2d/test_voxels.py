"""Columns of voxels: marked, cleared by rays, and what becomes of the costs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.navigation.costmap_2d import voxels
from rosmini.navigation.costmap_2d.voxels import UNKNOWN, clear_voxels, mark_voxels, marked_count

FRAME = np.array((0.0, 0.0, 0.0, 0.1, 0.2, 2.0))
COORDINATES = st.tuples(st.floats(-1, 3), st.floats(-1, 3), st.floats(-0.5, 3))


def grid(value=254):
    return np.full((20, 20), UNKNOWN | UNKNOWN << 16, dtype=np.int64), np.full((20, 20), value, dtype=np.uint8)


def clear(columns, costs, sensor, ends, reach=100, marks=0, unknown=15, kernel=clear_voxels):
    points = np.array(ends, dtype=float).reshape(-1, 3)
    return kernel(columns, costs, FRAME, np.array(sensor, dtype=float), points, 10, reach, marks, unknown + 6)


def marked_heights(column: int, size_z: int) -> list[int]:
    return [z for z in range(size_z) if column >> (16 + z) & 1]


def test_a_ray_clears_its_voxels_and_not_those_above():
    columns, costs = grid()
    clear(columns, costs, (0.05, 0.05, 0.1), [(1.55, 0.05, 0.1)])
    assert [marked_heights(int(column), 10) for column in columns[0, :16]] == (
        [[1, 2, 3, 4, 5, 6, 7, 8, 9]] * 14 + [list(range(10))] * 2
    ), "two cells before its end a ray clears no more"
    assert (costs == 254).all(), "a column with marked voxels stays an obstacle"


def test_a_column_without_marks_is_free_or_unknown_by_the_thresholds():
    for unknown, cost in ((15, 0), (8, 255), (9, 0)):
        columns, costs = grid()
        columns[...] = UNKNOWN
        clear(columns, costs, (0.05, 0.05, 0.1), [(1.55, 0.05, 0.1)], unknown=unknown)
        assert set(costs[0, :14]) == {cost}


def test_marks_up_to_the_threshold_are_free():
    columns, costs = grid()
    columns[...] = UNKNOWN
    mark_voxels(columns, np.array([3, 3]), np.array([0, 0]), np.array([4, 5]))
    clear(columns, costs, (0.05, 0.05, 0.1), [(1.55, 0.05, 0.1)], marks=1)
    assert costs[0, 3] == 254
    clear(columns, costs, (0.05, 0.05, 0.1), [(1.55, 0.05, 0.1)], marks=2)
    assert costs[0, 3] == 0


@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 15)), max_size=30))
def test_what_is_marked_is_counted(marks):
    columns = np.full((1, 4), UNKNOWN, dtype=np.int64)
    if marks:
        mx, mz = np.array(marks).T
        mark_voxels(columns, mx, np.zeros_like(mx), mz)
    for x in range(4):
        heights = sorted({z for at, z in marks if at == x})
        assert marked_heights(int(columns[0, x]), 16) == heights
        assert marked_count(columns)[0, x] == len(heights)


@given(COORDINATES, st.lists(COORDINATES, max_size=6), st.integers(0, 40))
def test_machine_code_clears_the_same_and_nothing_leaves_the_grid(sensor, ends, reach):
    inside = tuple(min(max(value, 0.01), 1.95) for value in sensor)
    one, other = grid(), grid()
    box = clear(*one, inside, ends, reach)
    assert clear(*other, inside, ends, reach, kernel=voxels.compiled_clear_voxels()) == box
    assert (one[0] == other[0]).all()
    assert (one[1] == other[1]).all()
    rows, columns = np.nonzero(one[0] != grid()[0])
    if len(rows):
        assert box[0] <= columns.min() <= columns.max() <= box[2]
        assert box[1] <= rows.min() <= rows.max() <= box[3]


@pytest.mark.parametrize("end", [(math.nan, 1, 1), (math.inf, 1, 1), (0.05, 0.05, 0.1)])
def test_an_end_that_is_no_point_clears_nothing(end):
    columns, costs = grid()
    clear(columns, costs, (0.05, 0.05, 0.1), [end])
    assert (columns == grid()[0]).all()
