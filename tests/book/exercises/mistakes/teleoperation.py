"""Wrong answers to the exercises of the chapter Teleoperation: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

JOYSTICK = solution("teleoperation", "joystick")

LOCK = solution("teleoperation", "lock")

GUARD_BACK = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

ahead = behind = 0.0

def on_scan(scan):
    global ahead, behind
    ahead = min(scan.ranges[-30:] + scan.ranges[:31])
    behind = min(scan.ranges[150:211])

def on_wish(command):
    if ahead < 0.3:
        command.linear.x = min(command.linear.x, 0.0)
    if behind < 0.3:
        command.linear.x = max(command.linear.x, 0.0)
    cmd_vel.publish(command)

rospy.init_node("guard")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
rospy.Subscriber("wish", Twist, on_wish)
rospy.spin()
"""


MISTAKES = {
    "joystick": [
        wrong("joystick.py", JOYSTICK, "    if joy.buttons[4]:", "    if True:"),
        wrong("joystick.py", JOYSTICK, "buttons[4]", "buttons[3]"),
        wrong("joystick.py", JOYSTICK, "axes[1]", "axes[0]"),
        wrong("joystick.py", JOYSTICK, "2.84 * ", "-2.84 * "),
        wrong("joystick.py", JOYSTICK, "    cmd_vel.publish(command)", "        cmd_vel.publish(command)"),
        wrong("joystick.py", JOYSTICK, '"joy"', '"joystick"'),
    ],
    "lock": [
        wrong("lock.py", LOCK, "    if locked:\n        cmd_vel.publish(Twist())\n"),
        wrong("lock.py", LOCK, "    if not locked:", "    if True:"),
        wrong("lock.py", LOCK, "    locked = stop.data", "    locked = True"),
        wrong("lock.py", LOCK, "    global locked\n"),
        wrong("lock.py", LOCK, "    if locked:\n        ", "    "),
        wrong("lock.py", LOCK, '"wish"', '"cmd_vel"'),
    ],
    "guard_back": [
        wrong("guard_back.py", GUARD_BACK, "    if behind < 0.3:", "    if behind < 0.0:"),
        wrong("guard_back.py", GUARD_BACK, "    if ahead < 0.3:", "    if ahead < 0.0:"),
        wrong("guard_back.py", GUARD_BACK, "min(command.linear.x, 0.0)", "0.0"),
        wrong("guard_back.py", GUARD_BACK, "max(command.linear.x, 0.0)", "0.0"),
        wrong("guard_back.py", GUARD_BACK, "ranges[150:211]", "ranges[0:1]"),
        wrong("guard_back.py", GUARD_BACK, "ahead < 0.3", "ahead < 0.9"),
        wrong(
            "guard_back.py",
            GUARD_BACK,
            "    cmd_vel.publish(command)",
            "    if ahead > 0.3:\n        cmd_vel.publish(command)",
        ),
    ],
}
