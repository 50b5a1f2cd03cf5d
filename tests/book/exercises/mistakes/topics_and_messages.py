"""Wrong answers to the exercises of the chapter Topics and messages: right ones with a fault put in."""

from __future__ import annotations

from .nodes_and_master import wrong
from .published import solution

FACE = solution("topics_and_messages", "face")

FRESH = solution("topics_and_messages", "fresh")

BLOCKED = solution("topics_and_messages", "blocked")

PRIORITY = solution("topics_and_messages", "priority")


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
