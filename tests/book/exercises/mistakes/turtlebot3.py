"""Wrong answers to the exercises of the chapter TurtleBot3: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

EIGHT = solution("turtlebot3", "eight")

DRIVE_ON = """while not rospy.is_shutdown():
    cmd_vel.publish(command)
    rate.sleep()
"""

DOCK = solution("turtlebot3", "dock")

FOLLOW = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def nearest(scan, first, last):
    found = [r for r in scan.ranges[first:last] if scan.range_min <= r <= scan.range_max]
    return min(found, default=scan.range_max)

def on_scan(scan):
    command = Twist()
    ahead = min(nearest(scan, 0, 15), nearest(scan, 345, 360))
    if ahead < 0.5:
        command.angular.z = 1.0
    else:
        command.linear.x = 0.15
        error = 0.57 - nearest(scan, 312, 319)
        command.angular.z = max(-0.8, min(0.8, 2.0 * error))
    cmd_vel.publish(command)

rospy.init_node("follow")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""

SAVER = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import BatteryState

voltage = 0.0

def on_battery(battery):
    global voltage
    voltage = battery.voltage

def on_wish(wish):
    cmd_vel.publish(wish if voltage >= 11.0 else Twist())

rospy.init_node("saver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("wish", Twist, on_wish)
rospy.Subscriber("battery_state", BatteryState, on_battery)
rospy.spin()
"""

MISTAKES = {
    "eight": [
        wrong("eight.py", EIGHT, "(0.5, -0.5)", "(-0.5, 0.5)"),
        wrong("eight.py", EIGHT, "(0.5, -0.5)", "(0.5, 0.5)"),
        wrong("eight.py", EIGHT, "(0.5, -0.5)", "(0.4, -0.4)"),
        wrong("eight.py", EIGHT, "2 * math.pi", "math.pi"),
        wrong("eight.py", EIGHT, "cmd_vel.publish(Twist())", DRIVE_ON),
        wrong("eight.py", "print('eight')"),
    ],
    "dock": [
        wrong(
            "dock.py",
            DOCK,
            "    if not scan.range_min <= distance <= scan.range_max:\n        distance = scan.range_max\n",
        ),
        wrong("dock.py", DOCK, "distance - 0.30", "distance - 0.35"),
        wrong("dock.py", DOCK, "min(0.2, 0.5 * (distance - 0.30))", "0.2"),
        wrong("dock.py", DOCK, "0.5 * (distance - 0.30)", "0.02 * (distance - 0.30)"),
        wrong("dock.py", DOCK, "scan.ranges[0]", "scan.ranges[180]"),
        wrong("dock.py", DOCK, "scan.ranges[0]", "scan.range[0]"),
    ],
    "follow_wall": [
        wrong("follow.py", FOLLOW, "0.57 - nearest", "1.3 - nearest"),
        wrong("follow.py", FOLLOW, "312, 319", "42, 49"),
        wrong("follow.py", FOLLOW, "ahead < 0.5", "ahead < 0.0"),
        wrong("follow.py", FOLLOW, "= 0.15", "= 0.0"),
        wrong("follow.py", FOLLOW, "2.0 * error", "-2.0 * error"),
        wrong("follow.py", FOLLOW, "scan.ranges[first:last]", "scan.range[first:last]"),
    ],
    "low_battery": [
        wrong("saver.py", SAVER, ">= 11.0", "< 11.0"),
        wrong("saver.py", SAVER, "wish if voltage >= 11.0 else Twist()", "wish"),
        wrong("saver.py", SAVER, "wish if voltage >= 11.0 else Twist()", "Twist()"),
        wrong("saver.py", SAVER, "battery.voltage", "battery.volts"),
        wrong("saver.py", SAVER, '"wish"', '"wishes"'),
    ],
}
