"""The chapter The environment: its terminals answer what the text says."""

from __future__ import annotations

import re

from .conftest import printed


def test_a_second_terminal_has_to_source_for_itself(cells):
    first, second = re.findall(r"printenv \| grep ROS\n((?:[A-Z_]+=.*\n)*)", printed(cells, "--at second"))
    assert first == ""
    assert "ROS_PACKAGE_PATH=/opt/ros/noetic/share\n" in second


def test_the_slip_in_the_path_is_found(cells):
    said = printed(cells, "report_ws/scr")
    assert "package 'turtlebot3_ds' not found" in said
    assert "Not all paths in ROS_PACKAGE_PATH" in said
    corrected = printed(cells, "source ~/report_ws/devel")
    assert corrected.rstrip().endswith("~/report_ws/src/turtlebot3_ds")
