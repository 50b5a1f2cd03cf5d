"""A map and its cells: where they lie, and messages of it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.maps import GridMap, MapDataError, MapMetadataError
from rosmini.core.time import Time
from rosmini.msgs import message_class

CELLS = np.array([[0, 100, -1], [50, 0, 0]], dtype=np.int8)


def test_cells_lie_where_ros_says():
    grid = GridMap(CELLS, 0.5, (1.0, 2.0, 0.0))
    assert grid.map_to_world(0, 0) == (1.25, 2.25)
    assert grid.map_to_world(2, 1) == (2.25, 2.75)
    assert grid.world_to_map(1.0, 2.0) == (0, 0)
    assert grid.world_to_map(2.49, 2.99) == (2, 1)
    assert grid.world_to_map(2.51, 2.5) is None
    assert grid.world_to_map(0.99, 2.5) is None


def test_an_origin_that_is_turned_turns_the_cells():
    grid = GridMap(CELLS, 1.0, (0.0, 0.0, math.pi / 2))
    assert grid.map_to_world(2, 0) == pytest.approx((-0.5, 2.5))
    assert grid.world_to_map(-1.5, 0.5) == (0, 1)
    assert grid.world_to_map(0.5, 0.5) is None


@given(
    st.floats(0.01, 2.0), st.floats(-50, 50), st.floats(-50, 50), st.floats(-4, 4),
    st.integers(0, 2), st.integers(0, 1),
)  # fmt: skip
def test_the_middle_of_a_cell_is_in_it(resolution, x, y, yaw, mx, my):
    grid = GridMap(CELLS, resolution, (x, y, yaw))
    assert grid.world_to_map(*grid.map_to_world(mx, my)) == (mx, my)


def test_masks_and_names():
    grid = GridMap(CELLS, 0.5, (0.0, 0.0, 0.0))
    assert grid.free.sum() == 3
    assert grid.occupied.tolist() == [[False, True, False], [False] * 3]
    assert grid.unknown.tolist() == [[False, False, True], [False] * 3]
    assert "3 x 2 cells of 0.5 m" in repr(grid)


def test_a_message_has_all_of_it():
    message = GridMap(CELLS, 0.05, (1.0, -2.0, 0.5)).to_message("world", Time(7))
    assert message.header.frame_id == "world"
    assert message.header.stamp == message.info.map_load_time == Time(7)
    assert (message.info.width, message.info.height) == (3, 2)
    assert list(message.data) == [0, 100, -1, 50, 0, 0]
    assert message.info.origin.orientation.z == pytest.approx(math.sin(0.25))
    back = GridMap.from_message(message)
    assert (back.occupancy == CELLS).all()
    assert back.origin == pytest.approx((1.0, -2.0, 0.5))
    assert back.path is None


def test_a_script_s_message_is_read_too():
    message = message_class("nav_msgs/OccupancyGrid")()
    message.info.width, message.info.height, message.info.resolution = 2, 1, 0.1
    message.data = (0, -1)
    grid = GridMap.from_message(message)  # its orientation was never set
    assert grid.origin == (0.0, 0.0, 0.0)
    assert grid.occupancy.tolist() == [[0, -1]]


@pytest.mark.parametrize(
    ("change", "error", "said"),
    [
        ({"width": 3}, MapDataError, "a map of 3 x 2 cells needs 6 of them.* its message has 4"),
        ({"width": 0}, MapDataError, "a map of 0 x 2 cells"),
        ({"resolution": 0.0}, MapMetadataError, "cells are 0.0 m wide"),
        ({"resolution": math.nan}, MapMetadataError, "cells are nan m wide"),
    ],
)  # fmt: skip
def test_a_message_that_is_no_map_is_told(change, error, said):
    message = GridMap(np.zeros((2, 2), dtype=np.int8), 0.05, (0.0, 0.0, 0.0)).to_message()
    for name, value in change.items():
        setattr(message.info, name, value)
    with pytest.raises(error, match=said):
        GridMap.from_message(message)
