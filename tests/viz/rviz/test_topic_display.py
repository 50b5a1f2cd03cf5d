"""Messages wait for their frames, are kept for as long as asked, and what is wrong with them is a status."""

import numpy as np
import pytest

from rosmini.core.time import Duration, Time
from rosmini.msgs.geometry_msgs.msg import Pose
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String
from rosmini.viz.rviz.primitives import DisplayError
from rosmini.viz.rviz.topic_display import Received


def scan(*ranges):
    return LaserScan(ranges=ranges or (1.0, 2.0), range_min=0.1, range_max=3.5, angle_increment=0.5)


def test_no_messages_and_why(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    scene.update()
    level, text = statuses(display)["Topic"]
    assert level == "Warn" and "nobody publishes /scan" in text
    stage.node.publisher("/scan", LaserScan)
    scene.update()
    level, text = statuses(display)["Topic"]
    assert level == "Warn" and "/robot published nothing" in text


def test_a_topic_of_another_type_is_named(stage, statuses):
    stage.node.publisher("/chatter", String)
    scene, display = stage.display("LaserScan", "/chatter")
    scene.update()
    level, text = statuses(display)["Topic"]
    assert level == "Error"
    assert "/chatter has the type std_msgs/String, and this display shows sensor_msgs/LaserScan" in text


def test_an_empty_topic_is_an_error(stage, statuses):
    _, display = stage.display("LaserScan")
    assert statuses(display)["Topic"] == ("Error", "Error subscribing: Empty topic name")


def test_messages_are_counted_and_placed(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    stage.place("map", "laser", (1.0, 2.0, 0.0))
    for _ in range(3):
        stage.publish("/scan", scan(1.0), "laser")
        stage.place("map", "laser", (1.0, 2.0, 0.0))
        stage.graph.run(0.1)
    (points,) = scene.update()[0].primitives
    assert points.points == pytest.approx(np.array([(2.0, 2.0, 0.0)]))
    assert statuses(display) == {
        "Topic": ("Ok", "3 messages received"),
        "Transform [sender=/robot]": ("Ok", "Transform OK"),
        "Points": ("Ok", "Showing [1] points from [1] messages"),
    }


def test_frames_that_do_not_connect_are_named(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    stage.place("map", "odom")
    stage.publish("/scan", scan(), "laser")
    scene.update()
    name = "Transform [sender=/robot]"
    assert statuses(display)[name] == ("Error", "For frame [laser]: Frame [laser] does not exist")
    stage.place("base", "laser")
    stage.publish("/scan", scan(), "laser")
    level, text = statuses(display)[name]
    assert level == "Error"
    assert text.startswith("For frame [laser]: No transform from [laser] to fixed frame [map]. TF error: [")
    scene.fixed_frame = "nowhere"
    stage.publish("/scan", scan(), "laser")
    assert statuses(display)[name] == ("Error", "For frame [laser]: Fixed Frame [nowhere] does not exist")


def test_a_message_waits_for_its_transform(stage):
    scene, _ = stage.display("LaserScan", "/scan")
    stage.publish("/scan", scan(), "laser")
    assert scene.update()[0].primitives == ()
    stage.place("map", "laser")
    stage.graph.run(0.1)
    assert scene.update()[0].primitives == ()  # known from later on only


def test_a_message_from_before_the_transforms_is_dropped_with_the_reason(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    stage.place("map", "laser")
    stage.graph.run(0.1)
    late = scan()
    late.header.frame_id, late.header.stamp = "laser", Time(1)
    stage.publish("/scan", late)
    scene.update()
    text = "Message removed because it is too old (frame=[laser], stamp=[1.000000000])"
    assert statuses(display)["Transform [sender=/robot]"] == ("Error", text)


def test_points_decay(stage):
    scene, display = stage.display("LaserScan", "/scan", more={"Decay Time": 1.0})
    for _ in range(5):
        stage.publish("/scan", scan(1.0), "map", settle=0.4)
    assert len(scene.update()[0].primitives) == 2
    stage.graph.run(10.0)
    assert len(scene.update()[0].primitives) == 1  # the last one stays
    display["Decay Time"] = 0.0
    stage.publish("/scan", scan(1.0), "map")
    assert len(scene.update()[0].primitives) == 1


def test_a_quaternion_of_zeros_is_no_rotation_and_noted():
    received = Received(scan(), 0)
    pose = Pose()
    pose.position.x, pose.orientation.w = 1.0, 0.0
    assert received.pose(pose)[:3, 3] == pytest.approx([1, 0, 0])
    received.pose(pose)
    (note,) = received.notes
    assert "quaternion" in note
    pose.position.x = float("nan")
    with pytest.raises(DisplayError, match="nans or infs"):
        received.pose(pose)


def test_what_is_dropped_from_the_queue_is_told_even_if_something_is_shown(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan", more={"Queue Size": 2})
    stage.place("map", "laser")
    stage.publish("/scan", scan(1.0), "laser")
    assert len(scene.update()[0].primitives) == 1
    for _ in range(3):
        ahead = scan(1.0)
        ahead.header.frame_id, ahead.header.stamp = "laser", stage.graph.now() + Duration(100)
        stage.publish("/scan", ahead)
    level, text = statuses(display)["Transform [sender=/robot]"]
    assert level == "Error"
    assert text.startswith("For frame [laser]: No transform from [laser] to fixed frame [map] at that time.")
    assert len(scene.update()[0].primitives) == 1


def test_a_message_without_a_frame_is_an_error(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    stage.place("map", "laser")
    stage.publish("/scan", scan(1.0))
    scene.update()
    assert statuses(display)["Transform [sender=/robot]"] == ("Error", "For frame []: Frame [] does not exist")


def test_a_scan_that_is_far_too_long_is_refused(stage, statuses):
    scene, display = stage.display("LaserScan", "/scan")
    stage.publish("/scan", scan(*[1.0] * 1_000_001), "map")
    assert scene.update()[0].primitives == ()
    level, text = statuses(display)["Topic"]
    assert level == "Error" and "1000001 ranges" in text and "1000000" in text.replace("1000001", "")
