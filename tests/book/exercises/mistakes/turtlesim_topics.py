"""Wrong answers to the exercises of the chapter turtlesim: topics: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

TRIANGLE = """
import rospy
from turtlesim.srv import SetPen, TeleportAbsolute

rospy.init_node("triangle")
rospy.wait_for_service("turtle1/set_pen")
pen = rospy.ServiceProxy("turtle1/set_pen", SetPen)
jump = rospy.ServiceProxy("turtle1/teleport_absolute", TeleportAbsolute)
pen(255, 0, 0, 5, 1)
jump(2, 2, 0)
pen(255, 0, 0, 5, 0)
for x, y in (9, 2), (5.5, 8), (2, 2):
    jump(x, y, 0)
"""

MIRROR = """
import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose


def on_pose(pose):
    twist = Twist()
    twist.linear.x = pose.linear_velocity
    twist.angular.z = -pose.angular_velocity
    commands.publish(twist)


rospy.init_node("mirror")
commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("pose", Pose, on_pose)
rospy.spin()
"""


def _script(text: str, old: str, new: str) -> Callable[[], Script]:
    assert old in text
    return lambda: Script("answer.py", text.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "corner": [
        lambda: "DAAA",
        lambda: "CAAA",
        lambda: "CCAAAA",
        lambda: "CCAA",
        lambda: "CDCDCCAAA",
        lambda: "XYZ",
        lambda: 61,
    ],
    "triangle": [
        _script(TRIANGLE, "pen(255, 0, 0, 5, 1)\n", ""),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(255, 0, 0, 3, 0)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(0, 255, 0, 5, 0)"),
        _script(TRIANGLE, ", (2, 2):", ":"),
        _script(TRIANGLE, "jump(x, y, 0)", "jump(x, y)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(256, 0, 0, 5, 0)"),
        _script(TRIANGLE, "(5.5, 8)", "(5, 8)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)\n", ""),
    ],
    "mirror": [
        _script(MIRROR, "-pose.angular_velocity", "pose.angular_velocity"),
        _script(MIRROR, "= pose.linear_velocity", "= -pose.linear_velocity"),
        _script(MIRROR, '"cmd_vel"', '"turtle2/cmd_vel"'),
        _script(MIRROR, "-pose.angular_velocity", "-2 * pose.angular_velocity"),
        _script(MIRROR, "-pose.angular_velocity", "-pose.theta"),
        _script(MIRROR, "    commands.publish(twist)\n", ""),
    ],
}
