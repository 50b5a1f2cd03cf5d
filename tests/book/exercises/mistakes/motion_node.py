"""Wrong answers to the exercises of the chapter A node that moves: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = """
import math

import rospy
from geometry_msgs.msg import Twist

rospy.init_node("turn")
publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(20)
while publisher.get_num_connections() == 0:
    rate.sleep()
start = rospy.Time.now()
command = Twist()
command.angular.z = 0.5
while 0.5 * (rospy.Time.now() - start).to_sec() < math.pi / 2:
    publisher.publish(command)
    rate.sleep()
publisher.publish(Twist())
rate.sleep()
"""

WALL = """
import math

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

rospy.init_node("wall")
publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(5)
command = Twist()
command.linear.x = 2
before = rospy.wait_for_message("/turtle1/pose", Pose)
while publisher.get_num_connections() == 0:
    rate.sleep()
while True:
    publisher.publish(command)
    rate.sleep()
    pose = rospy.wait_for_message("/turtle1/pose", Pose)
    if math.hypot(pose.x - before.x, pose.y - before.y) < 0.02:
        break
    before = pose
publisher.publish(Twist())
rospy.loginfo("wall")
rate.sleep()
"""

CORNERS = """
import math

import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

pose: dict = {}


def go_to(x, y):
    command = Twist()
    while (far := math.hypot(x - pose["now"].x, y - pose["now"].y)) > 0.05:
        angle = math.atan2(y - pose["now"].y, x - pose["now"].x) - pose["now"].theta
        angle = math.remainder(angle, 2 * math.pi)
        command.linear.x = min(1.5, 2 * far) * max(0.0, math.cos(angle))
        command.angular.z = 6 * angle
        publisher.publish(command)
        rate.sleep()
    publisher.publish(Twist())


rospy.init_node("corners")
publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
rospy.Subscriber("/turtle1/pose", Pose, lambda message: pose.update(now=message))
rate = rospy.Rate(50)
while not pose or publisher.get_num_connections() == 0:
    rate.sleep()
for corner in ((8, 2), (8, 8), (2, 8)):
    go_to(*corner)
rate.sleep()
"""


def _script(text: str, old: str, new: str) -> Callable[[], Script]:
    assert old in text
    return lambda: Script("answer.py", text.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "turn": [
        _script(TURN, "angular.z = 0.5", "angular.z = -0.5"),
        _script(TURN, "math.pi / 2", "math.pi"),
        _script(TURN, "angular.z = 0.5", "angular.z = 1.0"),
        _script(TURN, "command.angular.z", "command.linear.x = command.angular.z"),
        _script(TURN, "while 0.5 * (rospy.Time.now() - start).to_sec() < math.pi / 2:", "while True:"),
        _script(TURN, "publisher.publish(Twist())", "pass"),
        _script(TURN, "    publisher.publish(command)\n    rate.sleep()", "    publisher.publish(command)"),
        _script(TURN, "math.pi / 2", "90"),
    ],
    "wall": [
        _script(WALL, "math.hypot(pose.x - before.x, pose.y - before.y)", "abs(pose.x - before.x)"),
        _script(WALL, "math.hypot(pose.x - before.x, pose.y - before.y) < 0.02", "pose.x > 11"),
        _script(WALL, "        break", "        pass"),
        _script(WALL, "< 0.02", "< 0.39"),
        _script(
            WALL, "math.hypot(pose.x - before.x, pose.y - before.y) < 0.02", "not 0.1 < pose.x < 11 or pose.y > 11"
        ),
        _script(WALL, "rospy.loginfo(", "print("),
        _script(WALL, "    publisher.publish(command)", "    pass"),
        _script(WALL, 'rospy.loginfo("wall")', "pass"),
        _script(WALL, "    before = pose", '    rospy.loginfo("wall")\n    before = pose'),
    ],
    "corners": [
        _script(CORNERS, "(8, 2), (8, 8), (2, 8)", "(8, 8), (8, 2), (2, 8)"),
        _script(CORNERS, ", (2, 8)", ""),
        _script(CORNERS, "math.atan2(y - pose", "math.atan2(pose"),
        _script(CORNERS, "> 0.05", "> 0.5"),
        _script(CORNERS, "6 * angle", "-6 * angle"),
        _script(CORNERS, "> 0.05", "> 0"),
    ],
}
