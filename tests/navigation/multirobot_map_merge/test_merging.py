"""Maps laid over one another: what stays, where it lies, and what turned and scaled ones give."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.maps import GridMap, MapError
from rosmini.navigation.multirobot_map_merge.merging import merge


def grid(rows, resolution=0.5, origin=(0.0, 0.0, 0.0)) -> GridMap:
    return GridMap(np.array(rows, dtype=np.int8)[::-1], resolution, origin)


def test_one_map_stays_as_it_is():
    one = grid([[-1, 0], [100, 50]], origin=(-1.0, 2.0, 0.0))
    merged = merge([(one, (0.0, 0.0, 0.0))])
    assert merged.origin == one.origin
    assert (merged.occupancy == one.occupancy).all()


def test_of_two_the_most_occupied_stays_and_the_known_before_the_unknown():
    one = grid([[-1, 0, 100], [0, -1, 60]])
    other = grid([[0, 100, 0], [-1, -1, 70]])
    merged = merge([(one, (0.0, 0.0, 0.0)), (other, (0.0, 0.0, 0.0))])
    assert merged.occupancy[::-1].tolist() == [[0, 100, 100], [0, -1, 70]]


def test_a_map_lies_where_its_robot_began():
    merged = merge([(grid([[0]]), (1.0, 0.5, 0.0)), (grid([[100]]), (0.0, -0.5, 0.0))])
    assert merged.origin == (0.0, -0.5, 0.0)
    assert merged.occupancy[::-1].tolist() == [[-1, -1, 0], [-1, -1, -1], [100, -1, -1]]


def test_a_turned_map_is_turned_back():
    # The frame looks to the left of the world's: what is ahead of its origin is above it.
    merged = merge([(grid([[0, 10, 20]]), (0.0, 0.0, math.pi / 2))])
    assert merged.occupancy[::-1].tolist() == [[20], [10], [0]]
    assert merged.origin == pytest.approx((-0.5, 0.0, 0.0))


def test_the_cells_are_those_of_the_first_map():
    coarse = grid([[0, 100]], resolution=1.0)
    fine = grid([[50, 60], [70, 80]], resolution=0.5, origin=(2.0, 0.0, 0.0))
    merged = merge([(fine, (0.0, 0.0, 0.0)), (coarse, (0.0, 0.0, 0.0))])
    assert merged.resolution == 0.5
    assert merged.occupancy[::-1].tolist() == [[0, 0, 100, 100, 50, 60], [0, 0, 100, 100, 70, 80]]


@given(
    x=st.floats(-3, 3), y=st.floats(-3, 3), yaw=st.floats(-math.pi, math.pi),
    cells=st.lists(st.lists(st.sampled_from([-1, 0, 100]), min_size=6, max_size=6), min_size=4, max_size=4),
)  # fmt: skip
def test_nothing_is_invented_and_no_hole_comes_about(x, y, yaw, cells):
    one = grid(cells)
    merged = merge([(one, (x, y, yaw))])
    assert set(np.unique(merged.occupancy)) <= {*np.unique(one.occupancy), -1}
    for my in (1, 2):  # of the inner ones
        for mx in range(1, 5):
            along, across = (mx + 0.5) * 0.5, (my + 0.5) * 0.5
            point = (
                x + along * math.cos(yaw) - across * math.sin(yaw),
                y + along * math.sin(yaw) + across * math.cos(yaw),
            )
            cell = merged.world_to_map(*point)
            assert cell is not None
            around = one.occupancy[my - 1 : my + 2, mx - 1 : mx + 2]
            if (around == one.occupancy[my, mx]).all():
                assert merged.occupancy[cell[1], cell[0]] == one.occupancy[my, mx]


def test_what_cannot_be_merged_is_said():
    with pytest.raises(MapError, match="no maps"):
        merge([])
    with pytest.raises(MapError, match="init_pose"):
        merge([(grid([[0]]), (0.0, 0.0, 0.0)), (grid([[0]]), (1e5, 1e5, 0.0))])
