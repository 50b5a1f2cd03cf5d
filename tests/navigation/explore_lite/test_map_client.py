"""The map as the topics tell it."""

from __future__ import annotations

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.navigation.costmap_2d.publisher import published_values
from rosmini.navigation.explore_lite.map_client import MapClient, costs_by_value
from rosmini.navigation.explore_lite.node import ExploreParameters
from rosmini.navigation.nav_core import TransformMissing


def test_costs_that_were_published_come_back():
    costs = costs_by_value()[published_values().view(np.uint8)]
    assert costs[[0, 253, 254, 255]].tolist() == [0, 253, 254, 255]
    known = np.arange(253)
    assert (np.abs(costs[:253].astype(int) - known) <= 3).all()
    assert (np.diff(costs[:253].astype(int)) >= 0).all()


@pytest.fixture
def client(stage):
    stage.know(0.5, 0.5, 2.0, 2.0)
    node = stage.graph.node("explore")
    return MapClient(node, ExploreParameters(costmap_topic="map", costmap_updates_topic="map_updates"))


def update(stage, x, y, cells):
    message = message_class("map_msgs/OccupancyGridUpdate")()
    message.x, message.y = x, y
    message.height, message.width = np.shape(cells)
    message.data = np.ravel(cells).astype(np.int8)
    publisher = stage.node.publisher("map_updates", message_class("map_msgs/OccupancyGridUpdate"))
    stage.graph.run(0.1)
    publisher.publish(message)
    stage.graph.run(0.1)


def test_a_map_and_an_update(stage, client):
    grid = client.grid
    assert (grid.width, grid.height) == (40, 30)
    assert client.global_frame == "map"
    assert (grid.costs == 0).sum() == 15 * 15
    update(stage, 38, 28, [[100, 99], [0, -1]])
    assert grid.costs[28:, 38:].tolist() == [[254, 253], [0, 255]]
    update(stage, 39, 28, [[100, 99]])
    assert stage.said("An update of 2 x 1 cells at (39, 28) does not fit the map of 40 x 30")


def test_where_the_robot_is(stage, client):
    assert client.robot() == pytest.approx((1.05, 1.05))
    stage.timer.shutdown()
    stage.graph.run(1.0)
    with pytest.raises(TransformMissing, match=r"the transform_tolerance is 0\.3 s"):
        client.robot()


def test_a_map_whose_numbers_do_not_fit(stage, client):
    message = message_class("nav_msgs/OccupancyGrid")()
    message.info.width = message.info.height = 3
    message.data = [0] * 8
    stage.maps.publish(message)
    stage.graph.run(0.1)
    assert stage.said("A map has 8 cells, and its info says 3 x 3")
    assert (client.grid.width, client.grid.height) == (40, 30)
