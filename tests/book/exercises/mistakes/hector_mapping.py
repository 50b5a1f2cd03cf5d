"""Wrong answers to the exercises of the chapter Hector mapping: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .file_system import wrong

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

FITS = """
<launch>
  <include file="$(find turtlebot3_slam)/launch/turtlebot3_hector.launch">
    <arg name="model" value="burger"/>
    <arg name="odom_frame" value="base_footprint"/>
    <arg name="map_size" value="256"/>
  </include>
  <param name="hector_mapping/map_start_x" value="0.1"/>
</launch>
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
    "fits": (
        wrong(FITS, '  <param name="hector_mapping/map_start_x" value="0.1"/>\n'),
        wrong(FITS, "256", "512"),
        wrong(FITS, "start_x", "start_y"),
        wrong(FITS, '    <arg name="odom_frame" value="base_footprint"/>\n'),
        wrong(FITS, "turtlebot3_hector", "turtlebot3_gmapping"),
        lambda: 256,
    ),
    "level": (
        lambda: script(LEVEL, ("pitch, 0)", "pitch, yaw)")),
        lambda: script(LEVEL, ("(roll, pitch, 0)", "(pitch, roll, 0)")),
        lambda: script(LEVEL, ('"base_link", "base_stabilized"', '"base_stabilized", "base_link"')),
    ),
}
