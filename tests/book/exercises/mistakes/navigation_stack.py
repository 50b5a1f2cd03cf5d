"""Wrong answers to the exercises of the chapter The Navigation Stack: right ones with a fault put in."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

GOAL = """
import rospy
from geometry_msgs.msg import PoseStamped

rospy.init_node("go_there")
goals = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
while goals.get_num_connections() == 0:
    rospy.sleep(0.1)
goal = PoseStamped()
goal.header.frame_id = "map"
goal.pose.position.x, goal.pose.position.y = -1.0, 2.6
goal.pose.orientation.z = goal.pose.orientation.w = 0.7071
goals.publish(goal)
rospy.sleep(1.0)
"""


def _goal(old: str, new: str) -> Callable[[], Script]:
    assert old in GOAL
    return lambda: Script("go_there.py", GOAL.replace(old, new))


def straight(poses: Any) -> float:
    a, b = poses[0].pose.position, poses[-1].pose.position
    return math.dist((a.x, a.y), (b.x, b.y))


def between_ends(poses: Any) -> float:
    return straight(poses) if poses else 0.0


def along_x(poses: Any) -> float:
    return sum(abs(b.pose.position.x - a.pose.position.x) for a, b in pairwise(poses))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "demand": [lambda: 2, lambda: 3, lambda: 4, lambda: 0, lambda: "one", lambda: None],
    "go_there": [
        _goal("    rospy.sleep(0.1)\n", "    break\n"),
        _goal('goal.header.frame_id = "map"\n', ""),
        _goal('"map"', '"odom"'),
        _goal("-1.0, 2.6", "2.6, -1.0"),
        _goal("goal.pose.orientation.z = goal.pose.orientation.w = 0.7071\n", ""),
        _goal("goal.pose.orientation.z = goal.pose.orientation.w = 0.7071", "goal.pose.orientation.w = 1.0"),
        _goal("goal.pose.orientation.z =", "goal.pose.orientation.x ="),
        _goal("= 0.7071", "= 1.0"),
        _goal('"move_base_simple/goal"', '"move_base/goal"'),
        lambda: "rostopic pub -1 /move_base_simple/goal",
    ],
    "length": [lambda: straight, lambda: between_ends, lambda: along_x, lambda: len, lambda: 6.0],
}
