"""The static layer where it is not alone, does not cover the costmap, or its map changes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rosmini.msgs import message_class

from .conftest import ROBOT, SOURCE, WINDOW, layers, map_message

SCAN = {"observation_sources": "scan", "scan": SOURCE}


def lethal(costmap):
    """Where the obstacles are [m], in tenths."""
    grid = costmap.grid
    cells = np.argwhere(grid.costs == 254)
    return sorted(tuple(round(value, 2) for value in grid.map_to_world(mx, my)) for my, mx in cells)


@pytest.mark.parametrize(("rolls", "use_maximum"), [(False, False), (False, True), (True, False), (True, True)])
def test_obstacles_below_stand_with_use_maximum_alone(stage, rolls, use_maximum):
    stage.publish_map(np.zeros((40, 40)))
    place = WINDOW if rolls else ROBOT
    costmap = stage.costmap(
        plugins=layers("obstacles", "static"), obstacles=SCAN, static={"use_maximum": use_maximum}, **place
    )
    stage.scan([0.8] * 4, seconds=0.5)
    assert (costmap.grid.costs == 254).sum() == (4 if use_maximum else 0)


def test_a_rolling_window_shows_its_part_of_the_map(stage):
    occupancy = np.zeros((30, 20))
    occupancy[12, 15] = 100
    stage.publish_map(occupancy, origin=(0.5, 0.0))
    costmap = stage.costmap(plugins=layers("static"), **WINDOW, track_unknown_space=True)
    stage.graph.run(0.3)
    assert lethal(costmap) == [(2.05, 1.25)]
    # The window begins at (-1, -1), and is as the map has it where that is, unknown elsewhere.
    assert (costmap.grid.costs != 255).sum() == 20 * 30
    stage.pose = (2.03, 2.04, 0.0)
    stage.graph.run(0.5)
    assert costmap.grid.origin == pytest.approx((0.0, 0.0))
    assert lethal(costmap) == [(2.05, 1.25)]
    stage.pose = (-5.0, 2.04, 0.0)
    stage.graph.run(0.5)
    assert (costmap.grid.costs == 255).all()


def test_in_a_rolling_window_the_map_is_where_tf_says(stage):
    occupancy = np.zeros((40, 40))
    occupancy[30, 10] = 100
    stage.publish_map(occupancy)
    # What is at (1.05, 3.05) in the map is at (1.05, -0.05) in odom.
    stage.fixed.send("map", "odom", (1.0, 2.0, 0.0), yaw_quaternion(math.pi / 2))
    costmap = stage.costmap(plugins=layers("static"), **WINDOW)
    stage.graph.run(0.3)
    assert lethal(costmap) == [(1.05, -0.05)]


def yaw_quaternion(yaw):
    return 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)


@pytest.mark.parametrize("first_only", [False, True])
def test_a_second_map_is_taken_unless_the_first_is_the_only_one(stage, first_only):
    publisher = stage.publish_map([[0, 100], [0, 0]])
    costmap = stage.costmap(plugins=layers("static"), static={"first_map_only": first_only}, **ROBOT)
    stage.graph.run(0.3)
    assert (publisher.num_connections() == 0) == first_only
    publisher.publish(map_message([[100, 100, 100]], resolution=0.2))
    stage.graph.run(0.5)
    first, second = ([[0, 254], [0, 0]], 0.1), ([[254, 254, 254]], 0.2)
    costs, resolution = first if first_only else second
    assert costmap.grid.costs.tolist() == costs
    assert costmap.grid.resolution == pytest.approx(resolution)
    costmap.reset_layers()
    stage.graph.run(0.5)
    assert costmap.grid.costs.tolist() == costs


def test_updates_of_the_map_change_their_part_of_it(stage):
    stage.publish_map(np.zeros((10, 10)))
    costmap = stage.costmap(plugins=layers("static"), static={"subscribe_to_updates": True}, **ROBOT)
    stage.graph.run(0.3)
    send = updates(stage)
    send(2, 3, [[100, 0, 100], [0, -1, 0]])
    send(8, 8, [[0, 0], [0, 100]])
    stage.graph.run(0.3)
    expected = np.zeros((10, 10))
    expected[3, [2, 4]] = expected[9, 9] = 254
    expected[4, 3] = 255
    assert (costmap.grid.costs == expected).all()


@pytest.mark.parametrize(
    ("x", "y", "cells"), [(-1, 0, [[100, 100]]), (0, 9, [[100], [100]]), (2_000_000_000, 0, [[100]])]
)
def test_an_update_that_does_not_fit_is_told_and_not_taken(stage, capfd, x, y, cells):
    stage.publish_map(np.zeros((10, 10)))
    costmap = stage.costmap(plugins=layers("static"), static={"subscribe_to_updates": True}, **ROBOT)
    stage.graph.run(0.3)
    updates(stage)(x, y, cells)
    stage.graph.run(0.3)
    assert not costmap.grid.costs.any()
    assert "does not fit the map of 10 x 10" in "".join(capfd.readouterr())


def updates(stage):
    """What publishes a changed part (h, w) of the map, from a column and a row on."""
    kind = message_class("map_msgs/OccupancyGridUpdate")
    publisher = stage.robot.publisher("map_updates", kind)
    stage.graph.run(0.1)

    def send(x, y, cells):
        height, width = np.shape(cells)
        message = kind(x=x, y=y, width=width, height=height, data=np.ravel(cells).astype(np.int8))
        publisher.publish(message)

    return send
