"""Wrong answers to the exercise of the first steps, which its check has to refuse: right ones with one fault."""

from __future__ import annotations

from .nodes_and_master import wrong

STOP = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    command.linear.x = 0.2
    if scan.ranges[0] < 0.5:
        command.linear.x = 0.0
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
"""

MISTAKES = {
    "first_stop": [
        wrong("stop.py", STOP, "< 0.5", "> 0.5"),
        wrong("stop.py", STOP, "< 0.5", "< 0.0"),
        wrong("stop.py", STOP, "< 0.5", "< 2.0"),
        wrong("stop.py", STOP, "ranges[0]", "ranges[90]"),
        wrong("stop.py", STOP, "scan.ranges[0]", "scan.range"),
        wrong("stop.py", STOP, "x = 0.0", "x = 0.1"),
        wrong("stop.py", STOP, "linear.x = 0.0", "linear = 0"),
    ]
}
