"""Wrong answers to the exercises of the chapter Hector mapping: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

AROUND = """
import math
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("around")
wheels = rospy.Publisher("cmd_vel", Twist, queue_size=1)
command = Twist()
command.angular.z = 0.3
rate = rospy.Rate(10)
for _ in range(round(10 * 2 * math.pi / 0.3)):
    wheels.publish(command)
    rate.sleep()
wheels.publish(Twist())
"""

BEGIN = """
import math
import rospy
from geometry_msgs.msg import Pose
from hector_mapping.srv import ResetMapping

rospy.init_node("begin")
rospy.wait_for_service("restart_mapping_with_new_pose")
restart = rospy.ServiceProxy("restart_mapping_with_new_pose", ResetMapping)
pose = Pose()
pose.position.x, pose.position.y = 1.0, 0.5
pose.orientation.z = math.sin(math.pi / 4)
pose.orientation.w = math.cos(math.pi / 4)
restart(pose)
"""

LEVEL = """
import rospy
import tf
from sensor_msgs.msg import Imu
from tf.transformations import euler_from_quaternion, quaternion_from_euler


def on_imu(imu):
    q = imu.orientation
    roll, pitch, yaw = euler_from_quaternion([q.x, q.y, q.z, q.w])
    rotation = quaternion_from_euler(roll, pitch, 0)
    stamp = imu.header.stamp
    sender.sendTransform((0, 0, 0), rotation, stamp, "base_link", "base_stabilized")


rospy.init_node("level")
sender = tf.TransformBroadcaster()
rospy.Subscriber("imu", Imu, on_imu)
rospy.spin()
"""


def script(source: str, *changes: tuple[str, str]) -> Script:
    """A right answer with changes, each of which has to be in it."""
    for old, new in changes:
        assert old in source
        source = source.replace(old, new)
    return Script("answer.py", source)


def stepped(a, b, c, d, fx, fy):
    return a, b - a, c - a


def other_slopes(a, b, c, d, fx, fy):
    """As the original has it: each slope is weighed by the wrong fraction."""
    bottom, top = a + (b - a) * fx, c + (d - c) * fx
    along_x = (b - a) * (1 - fx) + (d - c) * fx
    return bottom + (top - bottom) * fy, along_x, top - bottom


MISTAKES: dict[str, tuple[Callable[[], Any], ...]] = {
    "slopes": (lambda: stepped, lambda: other_slopes, lambda: lambda *corners: 0.5, lambda: 3),
    "around": (
        lambda: script(AROUND, ("0.3", "2.6")),
        lambda: script(AROUND, ("2 * math.pi", "math.pi")),
        lambda: script(AROUND, ("wheels.publish(command)", "pass")),
    ),
    "begin": (
        lambda: script(BEGIN, ("restart(pose)", "print(pose)")),
        lambda: script(BEGIN, ("1.0, 0.5", "0.5, 1.0")),
        lambda: script(BEGIN, ("math.pi / 4", "math.pi / 2")),
    ),
    "level": (
        lambda: script(LEVEL, ("pitch, 0)", "pitch, yaw)")),
        lambda: script(LEVEL, ("(roll, pitch, 0)", "(pitch, roll, 0)")),
        lambda: script(LEVEL, ('"base_link", "base_stabilized"', '"base_stabilized", "base_link"')),
    ),
}
