"""Wrong answers to the exercises of the chapter Topics and messages: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong

FACE = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    command = Twist()
    nearest = scan.ranges.index(min(scan.ranges))
    if 10 < nearest <= 180:
        command.angular.z = 0.3
    elif 180 < nearest < 350:
        command.angular.z = -0.3
    cmd_vel.publish(command)

rospy.init_node("face")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""

FRESH = """
import rospy
from geometry_msgs.msg import Twist, TwistStamped

def on_command(command):
    age = rospy.Time.now() - command.header.stamp
    if age > rospy.Duration(0.5):
        cmd_vel.publish(Twist())
    else:
        cmd_vel.publish(command.twist)

rospy.init_node("fresh")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("remote_vel", TwistStamped, on_command)
rospy.spin()
"""

BLOCKED = """
import rospy
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

last = None

def on_scan(scan):
    global last
    blocked = scan.ranges[0] < 0.5
    if blocked != last:
        publisher.publish(blocked)
        last = blocked

rospy.init_node("watch")
publisher = rospy.Publisher("blocked", Bool, queue_size=1, latch=True)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.spin()
"""

PRIORITY = """
import rospy
from geometry_msgs.msg import Twist

last_joystick = 0.0

def on_joystick(command):
    global last_joystick
    last_joystick = rospy.get_time()
    cmd_vel.publish(command)

def on_navigation(command):
    if rospy.get_time() - last_joystick > 1.0:
        cmd_vel.publish(command)

rospy.init_node("priority")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("joy_vel", Twist, on_joystick)
rospy.Subscriber("nav_vel", Twist, on_navigation)
rospy.spin()
"""


MISTAKES = {
    "face": [
        wrong("face.py", FACE, "min(scan.ranges)", "max(scan.ranges)"),
        wrong("face.py", FACE, "10 < nearest <= 180", "nearest > 180"),
        wrong("face.py", FACE, "10 < nearest <= 180", "nearest >= 0"),
        wrong("face.py", FACE, "angular.z = 0.3", "linear.x = 0.1"),
        wrong("face.py", FACE, "10 < nearest", "60 < nearest"),
        wrong("face.py", FACE, "    cmd_vel.publish(command)\n"),
        wrong("face.py", FACE, "scan.ranges.index", "scan.range.index"),
    ],
    "fresh": [
        wrong("fresh.py", FRESH, "Duration(0.5)", "Duration(1.0)"),
        wrong("fresh.py", FRESH, "Duration(0.5)", "Duration(0.2)"),
        wrong("fresh.py", FRESH, "        cmd_vel.publish(Twist())", "        return"),
        wrong("fresh.py", FRESH, "age > ", "age < "),
        wrong("fresh.py", FRESH, '"remote_vel"', '"remote"'),
        wrong("fresh.py", FRESH, "publish(command.twist)", "publish(command)"),
    ],
    "blocked": [
        wrong("blocked.py", BLOCKED, ", latch=True"),
        wrong("blocked.py", BLOCKED, "    if blocked != last:\n", "    if True:\n"),
        wrong("blocked.py", BLOCKED, "< 0.5", "> 0.5"),
        wrong("blocked.py", BLOCKED, "ranges[0]", "ranges[180]"),
        wrong("blocked.py", BLOCKED, '"blocked"', '"is_blocked"'),
        wrong("blocked.py", BLOCKED, "        last = blocked\n"),
    ],
    "priority": [
        wrong("priority.py", PRIORITY, "> 1.0", "> 0.3"),
        wrong("priority.py", PRIORITY, "> 1.0", "> 3.0"),
        wrong("priority.py", PRIORITY, "    if rospy.get_time() - last_joystick > 1.0:\n    ", ""),
        wrong("priority.py", PRIORITY, "    last_joystick = rospy.get_time()\n", "    last_joystick = 9e9\n"),
        wrong("priority.py", PRIORITY, "rospy.get_time()\n    cmd_vel.publish(command)", "rospy.get_time()"),
        wrong("priority.py", PRIORITY, '"joy_vel"', '"joystick"'),
    ],
}
