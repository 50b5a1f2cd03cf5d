"""Clouds, old and new: their points, their colours, and for how long they stay."""

import math

import numpy as np
import pytest

from rosmini.msgs import message_class
from rosmini.msgs.std_msgs.msg import Header
from rosmini.ros.rospy.aliases import point_cloud2
from rosmini.viz.rviz import still

ChannelFloat32 = message_class("sensor_msgs/ChannelFloat32")
Point32 = message_class("geometry_msgs/Point32")
PointCloud = message_class("sensor_msgs/PointCloud")
PointField = message_class("sensor_msgs/PointField")

PLACES = [(1.0, 0.0, 0.0), (2.0, 0.0, 0.5), (math.nan, 0.0, 0.0), (3.0, 1.0, 1.0)]


def cloud(rows, *names):
    fields = [PointField(name, 4 * i, 6 if name == "rgb" else 7, 1) for i, name in enumerate(["x", "y", "z", *names])]
    return point_cloud2.create_cloud(Header(), fields, rows)


def drawn(stage, message, kind="PointCloud2", **properties):
    scene, display = stage.display(kind, "/cloud", more=properties)
    stage.place("map", "lidar", (0.0, 0.0, 2.0))
    stage.publish("/cloud", message, "lidar")
    found = scene.update()[0].primitives
    return (found[0] if found else None), display, scene


def test_points_are_in_the_fixed_frame_and_nan_is_left_out(stage, statuses):
    found, display, _ = drawn(stage, cloud(PLACES))
    assert found.points == pytest.approx(np.array([(1, 0, 2), (2, 0, 2.5), (3, 1, 3)]))
    assert statuses(display)["Points"] == ("Ok", "Showing [3] points from [1] messages")


def test_colours_by_transformer(stage):
    rows = [(*place, 0xFF0000 + i) for i, place in enumerate(PLACES)]
    found, _, _ = drawn(stage, cloud(rows, "rgb"), **{"Color Transformer": "RGB8"})
    assert found.colours[2] == pytest.approx(np.array((1, 0, 3 / 255, 1)))
    floats = [(*place, 0.25, 0.5, 1.0) for place in PLACES]
    found, _, _ = drawn(stage, cloud(floats, "r", "g", "b"), **{"Color Transformer": "RGBF32"})
    assert found.colours[0] == pytest.approx(np.array((0.25, 0.5, 1, 1)))
    found, _, _ = drawn(stage, cloud(floats, "r", "g", "b"), **{"Color Transformer": "AxisColor"})
    assert found.colours[0][:3] == pytest.approx(np.array((1, 0, 0)))


def test_a_transformer_that_the_cloud_has_no_channel_for_is_said(stage, statuses):
    found, display, _ = drawn(stage, cloud(PLACES), **{"Color Transformer": "RGB8"})
    assert found is None
    assert "No color transformer RGB8" in statuses(display)["Topic"][1]


@pytest.mark.nightly
def test_an_empty_cloud_is_warned_of_and_a_huge_one_thinned(stage, statuses):
    found, display, scene = drawn(stage, cloud([]))
    assert len(found.points) == 0
    assert statuses(display)["Points"] == ("Warn", "Showing [0] points from [1] messages")
    assert still(scene).svg
    rng = np.random.default_rng(1)
    huge = cloud([])
    points = rng.uniform(-5, 5, (2_100_000, 3)).astype("<f4")
    huge.width, huge.data, huge.row_step = len(points), points.tobytes(), points.nbytes
    found, _, scene = drawn(stage, huge, **{"Color Transformer": "FlatColor"})
    assert len(found.points) == 700_000
    assert len(still(scene, fit=True).svg) < 150_000


def test_points_decay(stage):
    scene, _ = stage.display("PointCloud2", "/cloud", more={"Decay Time": 1.0})
    for _ in range(3):
        stage.publish("/cloud", cloud(PLACES), "map", settle=0.3)
    assert len(scene.update()[0].primitives) == 3
    stage.graph.run(0.25)
    assert len(scene.update()[0].primitives) == 2


def test_the_older_message_has_channels_beside_its_points(stage, statuses):
    places = [Point32(*place) for place in PLACES]
    packed = np.array([0x00FF00] * 4, np.uint32).view(np.float32).tolist()
    message = PointCloud(points=places, channels=[ChannelFloat32("rgb", packed)])
    found, _, _ = drawn(stage, message, "PointCloud", **{"Color Transformer": "RGB8"})
    assert len(found.points) == 3
    assert found.colours[0] == pytest.approx(np.array((0, 1, 0, 1)))
    message.channels = [ChannelFloat32("intensity", [1.0])]
    found, display, _ = drawn(stage, message, "PointCloud")
    assert found is None
    assert "has 1 values for 4 points" in statuses(display)["Topic"][1]
