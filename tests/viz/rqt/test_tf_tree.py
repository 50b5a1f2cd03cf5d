"""The picture of the tree of frames."""

import xml.etree.ElementTree as ET

import pytest

from rosmini.core.tf import FrameTree
from rosmini.core.tf.rigid import rigid
from rosmini.viz.rqt.tf_tree import tf_tree
from rosmini.viz.view import ViewError

S = 1_000_000_000


def robot():
    tree = FrameTree()
    for tenth in range(10, 21):
        tree.set("map", "odom", rigid(), tenth * S // 10, "/amcl")
        tree.set("odom", "base_footprint", rigid(), tenth * S // 10, "/simulator")
    for child in ("base_scan", "imu_link"):
        tree.set("base_footprint", child, rigid(), 0, "/state_publisher", static=True)
    return tree


def test_its_text_says_all():
    assert tf_tree(robot(), title="Frames").text == (
        "Frames: 5 frames, 4 transforms\n"
        "base_footprint -> base_scan: Broadcaster: /state_publisher, static\n"
        "base_footprint -> imu_link: Broadcaster: /state_publisher, static\n"
        "map -> odom: Broadcaster: /amcl, Average rate: 11.0 Hz, Most recent: 2.000 s, Buffer length: 1.000 s\n"
        "odom -> base_footprint: Broadcaster: /simulator, Average rate: 11.0 Hz, Most recent: 2.000 s, "
        "Buffer length: 1.000 s"
    )


def test_its_alt_text():
    for part in ("5 frames", "base_scan, imu_link under base_footprint", "odom under map", "base_footprint under odom"):
        assert part in tf_tree(robot()).alt


def test_parents_are_above_their_children_and_labels_are_there():
    svg = ET.fromstring(tf_tree(robot()).svg)
    texts = [(t.text, float(t.get("y")), t.get("text-anchor")) for t in svg.iter("{http://www.w3.org/2000/svg}text")]
    height = {text: y for text, y, anchor in texts if anchor == "middle"}
    assert height["map"] < height["odom"] < height["base_footprint"] < height["base_scan"] == height["imu_link"]
    assert [text for text, _, _ in texts].count("Average rate: 11.0 Hz") == 2
    assert tf_tree(robot()).svg == tf_tree(robot()).svg


def test_no_frame_and_no_tree():
    assert "no transform" in tf_tree(FrameTree()).alt
    assert "(no frame to show)" in tf_tree(FrameTree()).svg
    with pytest.raises(ViewError, match="a dict has no tree"):
        tf_tree({})
