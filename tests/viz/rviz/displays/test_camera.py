"""Camera: the image, and the scene over it where the camera's projection puts it."""

import math
import re

import numpy as np
import pytest

from rosmini.core.tf import TransformBroadcaster
from rosmini.msgs import message_class

CameraInfo = message_class("sensor_msgs/CameraInfo")
Color = message_class("std_msgs/ColorRGBA")
ImageMessage = message_class("sensor_msgs/Image")
Marker = message_class("visualization_msgs/Marker")
OccupancyGrid = message_class("nav_msgs/OccupancyGrid")

WIDTH, HEIGHT = 60, 40
P = [50.0, 0, 30, 0, 0, 50, 20, 0, 0, 0, 1, 0]
BLUE = [0, 0, 200]


class Filmed:
    """A camera in the map's origin that looks along its x axis at what the test puts there."""

    def __init__(self, stage, statuses, **properties):
        self.stage, self.statuses = stage, statuses
        self.scene, self.display = stage.display(
            "Camera", more={"Image Topic": "/camera/image_raw", "Image Rendering": "background", **properties}
        )
        TransformBroadcaster(stage.node).send("map", "optical", (0.0, 0.0, 1.0), (-0.5, 0.5, -0.5, 0.5))
        stage.graph.run(0.1)

    def shoot(self, **info):
        data = bytes(BLUE) * (WIDTH * HEIGHT)
        image = ImageMessage(width=WIDTH, height=HEIGHT, encoding="rgb8", step=3 * WIDTH, data=data)
        image.header.frame_id = "optical"
        self.stage.publish("/camera/image_raw", image)
        if info:
            calibration = CameraInfo(**{"width": WIDTH, "height": HEIGHT, "P": P, **info})
            self.stage.publish("/camera/camera_info", calibration, "optical")
        return self.look()

    def look(self):
        panes = self.scene.update()[0].panes
        return panes[0] if panes else None

    def said(self):
        return self.statuses(self.display)

    def place_cube(self, x, y, z):
        if "Marker" not in [each.name for each in self.scene]:
            self.scene.add("Marker", {"Marker Topic": "/cube"})
            self.stage.graph.run(0.1)
        cube = Marker(type=Marker.CUBE, color=Color(0.0, 1.0, 0.0, 1.0))
        cube.pose.orientation.w = 1.0
        cube.pose.position.x, cube.pose.position.y, cube.pose.position.z = x, y, z
        cube.scale.x = cube.scale.y = cube.scale.z = 0.5
        self.stage.publish("/cube", cube, "map")


@pytest.fixture
def filmed(stage, statuses):
    return Filmed(stage, statuses)


def where(pane):
    """The middle of what is drawn over the image (column, row)."""
    corners = []
    for path in re.findall(r' d="([^"]*)"', pane.overlay):
        for line in re.findall(r"M([^z]*)", path):
            steps = [[float(number) for number in step.split(",")] for step in re.split("[l ]", line)]
            corners += np.cumsum(steps, axis=0).tolist()
    column, row = (np.min(corners, axis=0) + np.max(corners, axis=0)) / 2
    return float(column), float(row)


def test_the_scene_is_where_the_projection_puts_it(filmed):
    filmed.place_cube(5.0, 1.0, 1.5)
    pane = filmed.shoot(K=[1.0] * 9)
    column, row = where(pane)
    assert column == pytest.approx(30 - 50 * 1.0 / 4.75, abs=1.5)
    assert row == pytest.approx(20 - 50 * 0.5 / 4.75, abs=1.5)
    assert (pane.pixels == BLUE).all()
    assert filmed.said()["Camera Info"] == ("Ok", "OK")


def test_what_is_behind_the_camera_is_not_seen(filmed):
    filmed.place_cube(-5.0, 0.0, 1.0)
    assert filmed.shoot(K=[1.0] * 9).overlay == ""


def test_zoom_visibility_and_where_the_image_is(filmed):
    filmed.place_cube(5.0, 1.0, 1.5)
    filmed.shoot(K=[1.0] * 9)
    filmed.display["Zoom Factor"] = 2.0
    column, row = where(filmed.look())
    assert (column, row) == pytest.approx((30 - 100 / 4.75, 20 - 50 / 4.75), abs=2.5)
    filmed.display["Zoom Factor"] = 1.0
    filmed.display["Image Rendering"] = "background and overlay"
    assert 'opacity="0.5"' in filmed.look().overlay
    filmed.display["Image Rendering"] = "overlay"
    assert filmed.look().pixels[0, 0].tolist() == [24, 24, 124]
    filmed.display["Image Rendering"] = "background"
    filmed.display["Visibility"] = {"Marker": False}
    assert filmed.look().overlay == ""


def test_a_map_lies_on_the_ground(filmed):
    filmed.scene.add("Map", {"Topic": "/map", "Alpha": 1.0})
    filmed.stage.graph.run(0.1)
    grid = OccupancyGrid(data=[100] * 100)
    grid.info.width = grid.info.height = 10
    grid.info.resolution, grid.info.origin.position.y, grid.info.origin.orientation.w = 1.0, -5.0, 1.0
    filmed.stage.publish("/map", grid, "map")
    _, row = where(filmed.shoot(K=[1.0] * 9))
    assert row > 20


WRONG = {
    "nan": ({"P": [math.nan] * 12}, "Contains invalid floating point values (nans or infs)"),
    "zeros": ({"P": [0.0] * 12}, "must be more than 0, not 0 and 0"),
    "huge": ({"width": 4_000_000_000}, "is too large to draw"),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_calibration_that_is_none_is_said(filmed, name):
    info, text = WRONG[name]
    assert filmed.shoot(**info) is None
    level, said = filmed.said()["Camera Info"]
    assert (level, text in said) == ("Error", True)


def test_without_a_calibration_or_a_frame_nothing_is_seen_and_it_says_why(filmed):
    assert filmed.shoot() is None
    assert filmed.said()["Camera Info"] == (
        "Warn", "No CameraInfo received on [/camera/camera_info].  Topic may not exist."
    )  # fmt: skip
    image = ImageMessage(width=1, height=1, encoding="mono8", step=1, data=b"1")
    image.header.frame_id = "nowhere"
    filmed.stage.publish("/camera/camera_info", CameraInfo(width=1, height=1, P=P), "optical")
    filmed.stage.publish("/camera/image_raw", image)
    assert filmed.look() is None
    assert "Frame [nowhere] does not exist" in filmed.said()["Image"][1]
