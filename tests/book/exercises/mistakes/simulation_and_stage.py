"""Wrong answers to the exercises of the chapter Simulation and Stage: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong

STOP_IN_BOTH = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    ahead = round(-scan.angle_min / scan.angle_increment)
    if scan.ranges[ahead] > 0.45:
        command.linear.x = 0.2
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""

PAIR = """
define courier position
(
  size [0.3 0.3 0.2]
  drive "diff"
  ranger( pose [0 0 -0.05 0] sensor( range [0 3] fov 180 samples 181 ) )
)
courier( name "anna" pose [-1.5 -1 0 0] )
courier( name "bert" pose [1.5 -1 0 180] )
"""

SIDEWAYS = """
import math

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

def on_odom(odom):
    here = odom.pose.pose.position
    turn = odom.pose.pose.orientation
    heading = 2 * math.atan2(turn.z, turn.w)
    dx, dy = goal_x - here.x, goal_y - here.y
    command = Twist()
    command.linear.x = 0.5 * (math.cos(heading) * dx + math.sin(heading) * dy)
    command.linear.y = 0.5 * (math.cos(heading) * dy - math.sin(heading) * dx)
    cmd_vel.publish(command)

rospy.init_node("slider")
goal_x, goal_y = rospy.get_param("~x"), rospy.get_param("~y")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("odom", Odometry, on_odom, queue_size=1)
rospy.spin()
"""

ODOMETRY_ERROR = """
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32

def look():
    scan = rospy.wait_for_message("scan", LaserScan)
    odom = rospy.wait_for_message("odom", Odometry)
    return scan.ranges[90], odom.pose.pose.position.x

rospy.init_node("calibrate")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
result = rospy.Publisher("odom_error", Float32, queue_size=1, latch=True)
wall, start = look()
command = Twist()
command.linear.x = 0.2
for _ in range(50):
    cmd_vel.publish(command)
    rospy.sleep(0.1)
cmd_vel.publish(Twist())
rospy.sleep(0.5)
nearer, end = look()
result.publish((end - start) / (wall - nearer) - 1)
rospy.spin()
"""


def world(old: str, new: str = "") -> object:
    """Return what makes the right world with one place of it changed."""
    assert old in PAIR
    return lambda: PAIR.replace(old, new)


MISTAKES = {
    "stop_in_both": [
        wrong("stop_in_both.py", STOP_IN_BOTH, "[ahead]", "[0]"),
        wrong("stop_in_both.py", STOP_IN_BOTH, "[ahead]", "[90]"),
        wrong("stop_in_both.py", STOP_IN_BOTH, "> 0.45", "> 0.9"),
        wrong("stop_in_both.py", STOP_IN_BOTH, "> 0.45", "> 0.0"),
        wrong("stop_in_both.py", STOP_IN_BOTH, '"scan"', '"base_scan"'),
        wrong("stop_in_both.py", STOP_IN_BOTH, "scan.angle_min", "scan.angle_mim"),
    ],
    "pair_world": [
        lambda: 3,
        world("pose [0 0 -0.05 0] "),
        world("pose [1.5 -1 0 180]", "pose [1.5 -1 0 3.1416]"),
        world("pose [1.5 -1", "pose [1 -1"),
        world('courier( name "bert" pose [1.5 -1 0 180] )'),
        world("courier( name", "currier( name"),
        world("ranger(", "model("),
        world("courier( name", "model( pose [0 -1 0 0] size [0.1 1 1] )\ncourier( name"),
    ],
    "sideways": [
        wrong("sideways.py", SIDEWAYS, "    heading = 2 * math.atan2(turn.z, turn.w)", "    heading = 0.0"),
        wrong("sideways.py", SIDEWAYS, "- math.sin(heading) * dx", "+ math.sin(heading) * dx"),
        wrong("sideways.py", SIDEWAYS, "heading = 2 * ", "heading = "),
        wrong("sideways.py", SIDEWAYS, "    command.linear.y", "    command.angular.z"),
        wrong("sideways.py", SIDEWAYS, "    cmd_vel.publish(command)\n"),
        wrong("sideways.py", SIDEWAYS, "linear.x = 0.5 *", "linear.x = 0.05 *"),
    ],
    "odometry_error": [
        wrong("odometry_error.py", ODOMETRY_ERROR, " - 1)", ")"),
        wrong(
            "odometry_error.py", ODOMETRY_ERROR, "(end - start) / (wall - nearer)", "(wall - nearer) / (end - start)"
        ),
        wrong("odometry_error.py", ODOMETRY_ERROR, "range(50)", "range(1)"),
        wrong("odometry_error.py", ODOMETRY_ERROR, "range(50)", "range(500)"),
        wrong("odometry_error.py", ODOMETRY_ERROR, "ranges[90]", "ranges[0]"),
        wrong("odometry_error.py", ODOMETRY_ERROR, '"odom_error"', '"error"'),
        wrong(
            "odometry_error.py",
            ODOMETRY_ERROR,
            "result.publish((end - start) / (wall - nearer) - 1)",
            "result.publish(0.08)",
        ),
    ],
}
