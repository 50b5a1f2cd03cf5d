"""Wrong answers to the exercises of the chapter A goal by click: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

ONE_CLICK = solution("navigation_goal", "one_click")

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
for x, y in [(-2.0, 0.7), (-1.05, -0.8), (-2.3, 1.2)]:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x = x
    goal.target_pose.pose.position.y = y
    goal.target_pose.pose.orientation.w = 1
    client.send_goal(goal)
    if not client.wait_for_result(rospy.Duration(25)):
        client.cancel_goal()
        client.wait_for_result()
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "one_click": [
        _but(ONE_CLICK, "clicked.header.frame_id", '"odom"'),
        _but(ONE_CLICK, "yaw / 2", "yaw"),
        _but(ONE_CLICK, "    goal.pose.orientation.w = math.cos(yaw / 2)\n", ""),
        _but(ONE_CLICK, "    goals.publish(goal)\n", ""),
        _but(ONE_CLICK, "clicked.point.y - here.y, clicked.point.x - here.x", "clicked.point.y, clicked.point.x"),
    ],
    "home": [
        _but(HOME, "    goal.pose = begin.pose.pose\n", "    goal.pose.position = begin.pose.pose.position\n"),
        _but(
            HOME,
            "    goal.pose = begin.pose.pose\n",
            "    goal.pose.position = begin.pose.pose.position\n    goal.pose.orientation.z = 1.0\n",
        ),
        _but(HOME, "    goals.publish(goal)\n", ""),
        _but(HOME, "rospy.spin()", "rospy.sleep(0.5)\non_home(None)\nrospy.spin()"),
        _but(
            HOME,
            'begin = rospy.wait_for_message("amcl_pose", PoseWithCovarianceStamped)\n',
            "def on_pose(message):\n    global begin\n    begin = message\n\n"
            'rospy.Subscriber("amcl_pose", PoseWithCovarianceStamped, on_pose)\n',
        ),
    ],
    "waiter": [
        _but(WAITER, "rospy.Duration(25)", ""),
        _but(WAITER, "rospy.Duration(25)", "rospy.Duration(3)"),
        _but(WAITER, "        client.cancel_goal()\n        client.wait_for_result()\n", "        break\n"),
        _but(WAITER, "        client.cancel_goal()\n        client.wait_for_result()\n", "        continue\n"),
        _but(WAITER, "    goal.target_pose.pose.orientation.w = 1\n", ""),
        _but(WAITER, "    if not client", "    if x < -2.2:\n        break\n    if not client"),
    ],
}
