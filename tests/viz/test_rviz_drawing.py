"""The drawing of RViz's window."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from rosmini.viz.rviz_drawing import rviz_window


def test_six_parts_are_numbered():
    picture = rviz_window()
    words = [node.text for node in ET.fromstring(picture.svg).iter("{http://www.w3.org/2000/svg}text")]
    assert [each for each in words if each.isdigit()] == ["1", "2", "3", "4", "5", "6"]
    assert {"Displays", "Views"} <= set(words)
    assert all(f" {number}: " in picture.alt for number in range(1, 7))
