"""The voxel layer on a graph: heights, what it publishes, and that it rolls."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.msgs import message_class

from .conftest import SOURCE, WINDOW, layers

VOXELS = {
    "observation_sources": "scan cloud",
    "scan": SOURCE,
    "cloud": {"data_type": "PointCloud", "topic": "cloud", "marking": True, "clearing": False},
    "origin_z": 0.0,
    "z_resolution": 0.25,
    "z_voxels": 8,
}


def put(stage, *points):
    """Publish a cloud in odom, and let it be taken."""
    kind, point = message_class("sensor_msgs/PointCloud"), message_class("geometry_msgs/Point32")
    publisher = stage.robot.publisher("cloud", kind)
    stage.graph.run(0.05)
    message = kind()
    message.header.frame_id, message.header.stamp = "odom", stage.robot.now()
    message.points = [point(x=x, y=y, z=z) for x, y, z in points]
    publisher.publish(message)
    stage.graph.run(0.3)


@pytest.fixture
def costmap(stage):
    stage.pose = (0.02, 0.03, 0.0)
    return stage.costmap(plugins=layers("voxels"), voxels=VOXELS, **WINDOW)


def test_a_ray_below_a_table_does_not_clear_the_table(stage, costmap):
    put(stage, (1.03, 0.03, 0.8))
    cell = costmap.grid.world_to_map(1.03, 0.03)
    assert costmap.grid.cost(*cell) == 254
    stage.scan([2.0, math.inf, math.inf, math.inf])
    assert costmap.grid.cost(*cell) == 254


def test_the_columns_roll_with_the_window(stage, costmap):
    put(stage, (1.03, 0.03, 0.8))
    stage.pose = (0.52, -0.37, 0.0)
    stage.graph.run(0.5)
    grid = costmap.grid
    assert [(mx, my) for my, mx in np.argwhere(grid.costs == 254)] == [grid.world_to_map(1.03, 0.03)]
    columns = costmap.layers[0].columns
    assert [(mx, my) for my, mx in np.argwhere(columns >> 16)] == [grid.world_to_map(1.03, 0.03)]
