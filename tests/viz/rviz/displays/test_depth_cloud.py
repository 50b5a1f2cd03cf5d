"""DepthCloud: where pixels with depths are in space, and in which colours."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class

CameraInfo = message_class("sensor_msgs/CameraInfo")
ImageMessage = message_class("sensor_msgs/Image")
K = [10.0, 0.0, 1.0, 0.0, 20.0, 0.5, 0.0, 0.0, 1.0]


@pytest.fixture
def cloud(stage, statuses):
    """Publish depths (2, 3), colours and a calibration in the fixed frame; return the points and what is said."""

    def see(depths, colours=None, *, more=None, size=(3, 2), encoding="32FC1"):
        scene, display = stage.display(
            "DepthCloud", more={"Depth Map Topic": "/depth/image", "Color Image Topic": "/rgb/image", **(more or {})}
        )
        array = np.array(depths, np.float32 if encoding == "32FC1" else np.uint16)
        message = ImageMessage(width=3, height=2, encoding=encoding, step=3 * array.itemsize, data=array.tobytes())
        stage.publish("/depth/image", message, "map")
        if colours is not None:
            data = np.array(colours, np.uint8).tobytes()
            image = ImageMessage(width=3, height=len(data) // 9, encoding="rgb8", step=9, data=data)
            stage.publish("/rgb/image", image, "map")
        if size:
            stage.publish("/depth/camera_info", CameraInfo(width=size[0], height=size[1], K=K), "map")
        found = scene.update()[0].primitives
        return (found[0] if found else None), statuses(display)

    return see


def test_each_pixel_with_a_depth_is_a_point(cloud):
    points, said = cloud([[2.0, math.nan, 1.0], [0.0, math.inf, 4.0]])
    expected = [((0 - 1) * 0.2, -0.5 * 0.1, 2.0), (0.1, -0.5 * 0.05, 1.0), (0.4, 0.5 * 0.2, 4.0)]
    assert points.points == pytest.approx(np.array(expected), abs=1e-6)
    assert points.size == pytest.approx(0.2)
    assert said["Depth Image Size"] == ("Ok", "3 x 2")
    assert said["Points"] == ("Ok", "Showing [3] points from [1] messages")


def test_depths_in_millimetres_and_points_of_a_size(cloud):
    points, _ = cloud([[2000, 0, 1000], [0, 0, 0]], encoding="16UC1", more={"Auto Size": False, "Size (m)": 0.5})
    assert points.points[:, 2] == pytest.approx([2.0, 1.0])
    assert points.size == 0.5


def test_colours_are_those_of_the_other_image(cloud):
    colours = [[[255, 0, 0], [0, 255, 0], [0, 0, 255]], [[0, 0, 0]] * 3]
    points, _ = cloud([[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]], colours)
    assert points.colours[:, :3] == pytest.approx(np.eye(3))


def test_what_does_not_fit_is_said(cloud):
    assert "don't match: 3 x 2 vs 4 x 2" in cloud([[1.0] * 3] * 2, size=(4, 2))[1]["Topic"][1]
    points, said = cloud([[1.0] * 3] * 2, size=None)
    assert points is None
    assert said["CameraInfo"] == ("Warn", "No CameraInfo received on [/depth/camera_info]")
    _, said = cloud([[1.0] * 3] * 2, [[[0, 0, 0]] * 3] * 3)
    assert "(3x2) does not match color image resolution (3x3)" in said["Topic"][1]
