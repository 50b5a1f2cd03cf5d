"""What is under the pointer, and in a rectangle."""

import numpy as np
import pytest

from rosmini.msgs.nav_msgs.msg import OccupancyGrid
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.viz.rviz.picture import flat_projection
from rosmini.viz.rviz.selection import hit, picked


def scan():
    return LaserScan(
        angle_min=-1.0, angle_increment=1.0, range_min=0.1, range_max=9.0, ranges=[2.0, 2.0, 2.0], angle_max=1.0
    )


@pytest.fixture
def seen(stage):
    """The layers and the projection of a scan that has three points."""
    scene, _ = stage.display("LaserScan", "/scan")
    stage.place("map", "laser")
    stage.publish("/scan", scan(), "laser")
    layers = scene.update()
    return layers, flat_projection(scene, layers, 600, 400)


def test_a_rectangle_tells_which_points_are_in_it(seen):
    layers, look = seen
    (middle,) = look.pixels(np.array([[2.0, 0.0, 0.0]]))
    (found,) = picked(layers, look, middle - 5, middle + 5)
    assert (found.display.name, found.number) == ("LaserScan", 1)
    assert found.positions == pytest.approx(np.array([[2.0, 0.0, 0.0]]))
    assert "LaserScan (rviz/LaserScan): 1 " in found.words() and "2.000; 0.000; 0.000" in found.words()
    assert picked(layers, look, middle + 50, middle + 40) == []
    (everything,) = picked(layers, look, np.array([600, 400]), np.zeros(2))
    assert everything.number == 3


def test_the_nearest_point_is_hit_and_empty_ground_is_not(seen):
    layers, look = seen
    (middle,) = look.pixels(np.array([[2.0, 0.0, 0.0]]))
    assert hit(layers, look, middle + [3, -2]) == pytest.approx(np.array([2.0, 0.0, 0.0]))
    assert hit(layers, look, middle + [40, 0]) is None


def test_a_map_is_hit_anywhere_on_it(stage):
    grid = OccupancyGrid(data=[0] * 100)
    grid.info.width = grid.info.height = 10
    grid.info.resolution, grid.info.origin.orientation.w = 0.1, 1.0
    scene, _ = stage.display("Map", "/map")
    stage.place("map", "odom")
    stage.publish("/map", grid, "map")
    layers = scene.update()
    look = flat_projection(scene, layers, 600, 400)
    for place, is_on in (((0.5, 0.5), True), ((0.05, 0.95), True), ((1.1, 0.5), False), ((-0.1, 0.5), False)):
        (pixel,) = look.pixels(np.array([[*place, 0.0]]))
        found = hit(layers, look, pixel)
        assert (found is not None) == is_on
        if found is not None:
            assert found == pytest.approx(np.array([*place, 0.0]), abs=0.01)
