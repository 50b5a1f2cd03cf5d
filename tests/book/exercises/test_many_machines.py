"""The chapter Many machines: what its cells say, and other right answers."""

from __future__ import annotations

import pytest

from rosmini.book.checks import Status, find

from .conftest import printed


def test_one_teleop_drives_both_turtles_and_a_namespace_parts_them(cells, figures):
    first, second = [line for line in figures[2].splitlines() if line.startswith("turtle1")]
    assert first == second and "8.00 m" in first
    *_, one, _, two, _ = printed(cells, "/one/turtle1/pose/x").splitlines()
    assert one.startswith("5.54") and two.startswith("9.54")


def test_the_mistakes_have_their_messages(cells):
    assert "ERROR: Unable to communicate with master!" in printed(cells, "localhost:11312")
    assert "extrapolation 5.0" in printed(cells, "lookup_transform")
    assert "Average Delay: 5 Max Delay: 5" in printed(cells, "tf_monitor world robot")


def test_a_name_in_the_place_of_a_number_is_right_where_it_is_the_number():
    lines = "export ROS_MASTER_URI='http://192.168.1.10:11311/' ROS_HOSTNAME=192.168.1.42  # the tablet"
    assert find("bashrc").grade(lines).status is Status.RIGHT


@pytest.mark.parametrize(
    "lines",
    [
        "source /opt/ros/noetic/setup.bash\nexport ROS_MASTER_URI=http://192.168.1.10:11311 ROS_IP=192.168.1.42",
        "export ROS_MASTER_URI=http://192.168.1.10:11311; ROS_IP=192.168.1.42; export ROS_IP",
    ],
)
def test_other_ways_of_bash_are_right(lines):
    assert find("bashrc").grade(lines).status is Status.RIGHT


def test_what_is_set_and_not_exported_is_named():
    lines = "export ROS_MASTER_URI=http://192.168.1.10:11311\nROS_IP=192.168.1.42"
    assert "ROS_IP is set but not exported" in find("bashrc").grade(lines).text


def test_who_writes_into_the_file_is_told_that_its_lines_are_wanted():
    lines = 'echo "export ROS_IP=192.168.1.42" >> ~/.bashrc'
    assert "write the lines themselves" in find("bashrc").grade(lines).text
