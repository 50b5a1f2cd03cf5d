"""Range and GridCells."""

import math

import numpy as np
import pytest

from rosmini.msgs.geometry_msgs.msg import Point
from rosmini.msgs.nav_msgs.msg import GridCells
from rosmini.msgs.sensor_msgs.msg import Range


def echo(reach, low=0.1, high=4.0):
    return Range(field_of_view=math.pi / 2, min_range=low, max_range=high, range=reach)


def test_a_cone_is_as_long_as_the_range_and_opens_with_the_field_of_view(stage):
    scene, _ = stage.display("Range", "/sonar")
    stage.publish("/sonar", echo(2.0), "map")
    (cone,) = scene.update()[0].primitives
    low, high = cone.placed.min(axis=0), cone.placed.max(axis=0)
    assert low == pytest.approx([0.0, -2.0, -2.0], abs=0.05)
    assert high == pytest.approx([2.0, 2.0, 2.0], abs=0.05)


@pytest.mark.parametrize("reach", [0.05, 5.0, math.inf, math.nan])
def test_without_an_echo_there_is_no_cone(stage, statuses, reach):
    scene, display = stage.display("Range", "/sonar")
    stage.publish("/sonar", echo(reach), "map")
    assert scene.update()[0].primitives == ()
    assert statuses(display)["Range"][1].endswith("out of range: no cone")


def test_a_sensor_that_only_detects(stage):
    scene, _ = stage.display("Range", "/bumper")
    stage.publish("/bumper", echo(-math.inf, 0.5, 0.5), "map")
    (cone,) = scene.update()[0].primitives
    assert cone.placed[:, 0].max() == pytest.approx(0.5)
    stage.publish("/bumper", echo(math.inf, 0.5, 0.5), "map")
    assert scene.update()[0].primitives == ()


def test_cells_that_have_no_place_are_left_out(stage, statuses):
    scene, display = stage.display("GridCells", "/obstacles")
    cells = [Point(x=1.0), Point(x=math.nan), Point(x=3.0)]
    stage.publish("/obstacles", GridCells(cell_width=0.1, cell_height=0.1, cells=cells), "map")
    (points,) = scene.update()[0].primitives
    assert points.points == pytest.approx(np.array([(1, 0, 0), (3, 0, 0)]))
    assert (points.style, points.size) == ("Tiles", pytest.approx(0.1))
    assert statuses(display)["Message"] == ("Warn", "1 cells have invalid positions (nans or infs)")
    stage.publish("/obstacles", GridCells(cells=cells), "map")
    scene.update()
    assert statuses(display)["Topic"] == ("Error", "Cell width is 0, cells will be invisible")
