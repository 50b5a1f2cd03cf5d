"""The drawing of the frames of a robot on uneven ground."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from rosmini.viz.frame_drawings import frames_on_rough_ground

FRAMES = ("map", "odom", "base_footprint", "base_stabilized", "base_link", "base_scan")


def test_every_frame_is_named_in_the_drawing_and_described():
    picture = frames_on_rough_ground()
    words = [node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text")]
    for frame in FRAMES:
        assert frame in words
        assert frame in picture.alt
        assert frame in picture.text
