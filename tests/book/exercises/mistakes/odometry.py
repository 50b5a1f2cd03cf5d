"""Wrong answers to the exercises of the chapter Odometry: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

MILEAGE = """
import math

import rospy
from std_msgs.msg import Float64
from turtlebot3_msgs.msg import SensorState

TICK = 2 * math.pi * 0.033 / 4096
driven = 0.0
before = None

def on_state(state):
    global driven, before
    now = state.left_encoder, state.right_encoder
    if before is not None:
        left, right = now[0] - before[0], now[1] - before[1]
        driven += TICK * abs(left + right) / 2
    before = now
    mileage.publish(driven)

rospy.init_node("mileage")
mileage = rospy.Publisher("mileage", Float64, queue_size=1)
rospy.Subscriber("sensor_state", SensorState, on_state)
rospy.spin()
"""

CALIBRATE = solution("odometry", "calibrate")

SPIN_ON = """while not rospy.is_shutdown():
    cmd_vel.publish(spin)
    rospy.sleep(0.1)
"""

STUCK = """
import math

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

here = None
seen = None

def on_odom(odom):
    global here
    here = odom.pose.pose.position.x, odom.pose.pose.position.y

def on_scan(scan):
    global seen
    if here is None:
        return
    distance = max(scan.ranges[0], scan.range_min)
    if seen is None or abs(distance - seen[0]) >= 0.1:
        seen = distance, here
    stuck.publish(math.dist(here, seen[1]) >= 0.3)

rospy.init_node("stuck")
stuck = rospy.Publisher("stuck", Bool, queue_size=1)
rospy.Subscriber("odom", Odometry, on_odom, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""

MISTAKES = {
    "mileage": [
        wrong("mileage.py", MILEAGE, "abs(left + right)", "(left + right)"),
        wrong("mileage.py", MILEAGE, "abs(left + right)", "(abs(left) + abs(right))"),
        wrong("mileage.py", MILEAGE, "abs(left + right) / 2", "abs(left + right)"),
        wrong("mileage.py", MILEAGE, "before = None", "before = (0, 0)"),
        wrong("mileage.py", MILEAGE, "    mileage.publish(driven)\n"),
        wrong("mileage.py", MILEAGE, "left_encoder", "left_ticks"),
    ],
    "calibrate": [
        wrong("calibrate.py", CALIBRATE, "turned += math", "math"),
        wrong("calibrate.py", CALIBRATE, "rolled / turned", "0.1638"),
        wrong("calibrate.py", CALIBRATE, '"base_pose_ground_truth"', '"odom"'),
        wrong("calibrate.py", CALIBRATE, "range(400)", "range(1000)"),
        wrong("calibrate.py", CALIBRATE, "separation.publish(rolled / turned)\n"),
        wrong("calibrate.py", CALIBRATE, "rospy.spin()", SPIN_ON),
    ],
    "stuck": [
        wrong("stuck.py", STUCK, ">= 0.3", ">= 3.0"),
        wrong("stuck.py", STUCK, "abs(distance - seen[0]) >= 0.1", "False"),
        wrong("stuck.py", STUCK, ">= 0.3", "< 0.3"),
        wrong("stuck.py", STUCK, "stuck.publish(", "print("),
        wrong("stuck.py", STUCK, "scan.ranges[0]", "scan.range[0]"),
    ],
}
