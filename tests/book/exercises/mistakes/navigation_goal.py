"""Wrong answers to the exercises of the chapter A goal by click: right ones with a fault put in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script
from rosmini.msgs.geometry_msgs.msg import PoseStamped

if TYPE_CHECKING:
    from collections.abc import Callable

HOME = """
import rospy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from std_msgs.msg import Empty


def on_home(message):
    goal = PoseStamped()
    goal.header.frame_id = begin.header.frame_id
    goal.pose = begin.pose.pose
    goals.publish(goal)


rospy.init_node("home")
goals = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1)
begin = rospy.wait_for_message("amcl_pose", PoseWithCovarianceStamped)
rospy.Subscriber("home", Empty, on_home)
rospy.spin()
"""

WAITER = """
import actionlib
import rospy
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal

rospy.init_node("waiter")
client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
client.wait_for_server()
for x, y in [(1, 0), (2, 1), (0, 2)]:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.w = 1
    client.send_goal(goal)
    if not client.wait_for_result(rospy.Duration(5)):
        client.cancel_goal()
        client.wait_for_result()
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def goal_of(press: Any, release: Any, half: float = 2.0, frame: str = "map", at: str = "press") -> PoseStamped:
    goal = PoseStamped()
    goal.header.frame_id = frame
    goal.pose.position.x, goal.pose.position.y = press if at == "press" else release
    yaw = math.atan2(release[1] - press[1], release[0] - press[0])
    goal.pose.orientation.z, goal.pose.orientation.w = math.sin(yaw / half), math.cos(yaw / half)
    return goal


def unturned(press: Any, _: Any) -> PoseStamped:
    goal = goal_of(press, (press[0] + 1, press[1]))
    goal.pose.orientation.w = 0.0
    return goal


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "goal_of": [
        lambda: lambda press, release: goal_of(press, release, half=1.0),
        lambda: lambda press, release: goal_of(press, release, frame="odom"),
        lambda: lambda press, release: goal_of(press, release, at="release"),
        lambda: lambda press, release: goal_of(press, release).pose,
        lambda: unturned,
        lambda: lambda press, _: goal_of(press, (press[0] + 1, press[1])),
    ],
    "home": [
        _but(HOME, "begin.header.frame_id", '"map"'),
        _but(HOME, "    goal.pose = begin.pose.pose\n", "    goal.pose.position = begin.pose.pose.position\n"),
        _but(HOME, "    goals.publish(goal)\n", ""),
        _but(HOME, "rospy.spin()", "on_home(None)\nrospy.spin()"),
        _but(HOME, "    goal = PoseStamped()\n", "    goal = PoseStamped()\n    rospy.signal_shutdown('home')\n"),
        _but(
            HOME,
            'begin = rospy.wait_for_message("amcl_pose", PoseWithCovarianceStamped)\n',
            "def on_pose(message):\n    global begin\n    begin = message\n\n"
            'rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, on_pose)\n',
        ),
    ],
    "waiter": [
        _but(WAITER, "rospy.Duration(5)", ""),
        _but(WAITER, "rospy.Duration(5)", "rospy.Duration(2)"),
        _but(WAITER, "rospy.Duration(5)", "rospy.Duration(8)"),
        _but(WAITER, "        client.cancel_goal()\n        client.wait_for_result()\n", "        break\n"),
        _but(WAITER, "    goal.target_pose.pose.orientation.w = 1\n", ""),
        _but(WAITER, "        client.wait_for_result()\n", "        client.wait_for_result()\nrospy.spin()\n"),
        _but(WAITER, "(1, 0), (2, 1)", "(2, 1), (1, 0)"),
    ],
}
