"""The chapter turtlesim: nodes: what its cells say, and other right answers."""

from __future__ import annotations

import pytest

from rosmini.book.checks import Script, Status, find

from .conftest import printed


def test_the_slip_is_refused_and_one_command_drives_two_turtles(cells):
    assert "--name:=my_turtle" in printed(cells, "%%terminal --new")
    first, second = printed(cells, "__name:=one").strip().splitlines()[-2:]
    assert first == second


def test_a_namespace_keeps_the_windows_apart(cells):
    assert "/left/draw_square\n/left/turtlesim\n/right/turtlesim\n" in printed(cells, "__ns:=/right")
    assert "/draw_circle" in printed(cells, "rosnode ping -c 1 /draw_circle")
    assert "/draw_circle" not in printed(cells, "%rosnode cleanup").rpartition("\n/left")[2]


@pytest.mark.parametrize(
    "line",
    [
        "%rosrun turtlesim turtlesim_node __ns:=pond __name:=frog _background_r:=0",
        "$ rosmini rosrun turtlesim turtlesim_node \\\n    __name:='frog' __ns:=/pond _background_r:=0 &",
        "ROS_NAMESPACE=/pond rosrun turtlesim turtlesim_node __name:=frog _background_r:=0",
    ],
)
def test_a_command_is_right_as_it_is_copied(line):
    assert find("frog").grade(line).status is Status.RIGHT


def test_a_guard_may_look_in_a_loop_of_its_own():
    loop = """
import rospy
from turtlesim.msg import Pose

rospy.init_node("guard")
while True:
    pose = rospy.wait_for_message("turtle1/pose", Pose)
    if abs(pose.x - 5.5) > 2 or abs(pose.y - 5.5) > 2:
        break
rospy.loginfo("the turtle has left")
"""
    assert find("go_home").grade(Script("guard.py", loop)).status is Status.RIGHT
