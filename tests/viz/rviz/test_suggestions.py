"""Displays for what is published."""

from __future__ import annotations

from rosmini.msgs.nav_msgs.msg import OccupancyGrid, Odometry
from rosmini.viz.rviz.suggestions import suggested


def names(config):
    return [each["Name"] for each in config.mappings("Displays")]


def test_the_truth_of_a_simulator_is_shown_where_its_frame_is(stage):
    """Without a map there is no frame of that name either, and the display would be an error from the start."""
    for topic in ("/odom", "/base_pose_ground_truth", "/tb3_1/base_pose_ground_truth"):
        stage.publish(topic, Odometry(), "odom")
    assert set(names(suggested(stage.graph))) == {"Grid", "/odom", "TF"}
    stage.publish("/map", OccupancyGrid(), "map")
    assert {"/base_pose_ground_truth", "/tb3_1/base_pose_ground_truth"} < set(names(suggested(stage.graph)))


def test_frames_do_not_hide_a_small_robot(stage):
    stage.place("odom", "base_footprint")
    (frames,) = [each for each in suggested(stage.graph).mappings("Displays") if each["Class"] == "rviz/TF"]
    assert 0.2 * frames["Marker Scale"] < 0.08  # the axes' length against a Burger's 0.14 m
