"""Wrong answers to the exercises of the chapter Logging: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

WHY = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan

def on_scan(scan):
    ahead = min(scan.ranges[:20] + scan.ranges[-20:])
    rospy.logdebug("%.2f m ahead", ahead)
    command = Twist()
    if ahead > 0.5:
        command.linear.x = 0.2
    else:
        rospy.logwarn_throttle(5, "stopped: %.2f m ahead" % ahead)
    cmd_vel.publish(command)

rospy.init_node("driver")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan)
rospy.spin()
"""

ALARM = """
import rospy
from rosgraph_msgs.msg import Log
from std_msgs.msg import String

def on_log(log):
    if log.level >= Log.ERROR:
        alarm.publish("%s: %s" % (log.name, log.msg))

rospy.init_node("alarm")
alarm = rospy.Publisher("alarm", String, queue_size=10)
rospy.Subscriber("/rosout_agg", Log, on_log)
rospy.spin()
"""

CLOSER = solution("logging", "look_closer")


def _changed(name: str, source: str, before: str, after: str) -> Callable[[], Script]:
    assert before in source
    return lambda: Script(f"{name}.py", source.replace(before, after))


def _why(before: str, after: str) -> Callable[[], Script]:
    return _changed("say_why", WHY, before, after)


def _alarm(before: str, after: str) -> Callable[[], Script]:
    return _changed("alarm", ALARM, before, after)


def _closer(before: str, after: str) -> Callable[[], Script]:
    return _changed("look_closer", CLOSER, before, after)


MISTAKES = {
    "say_why": [
        _why("logwarn_throttle(5, ", "logwarn("),
        _why("logwarn_throttle(5, ", "loginfo_throttle(5, "),
        _why("logwarn_throttle(5, ", "logwarn_throttle(15, "),
        _why('"stopped: %.2f m ahead" % ahead', '"stopped"'),
        _why("rospy.logdebug", "rospy.loginfo"),
        _why('    rospy.logdebug("%.2f m ahead", ahead)\n', ""),
        _why("ahead > 0.5", "ahead > 0.0"),
        _why("command.linear.x = 0.2", "pass"),
    ],
    "log_alarm": [
        _alarm(">= Log.ERROR", ">= Log.WARN"),
        _alarm(">= Log.ERROR", "== Log.ERROR"),
        _alarm("if log.level >= Log.ERROR:", 'if "ERROR" in log.msg:'),
        _alarm("%s: %s", "%s %s"),
        _alarm("if log.level >= Log.ERROR:", "if log.level >= Log.ERROR and log.name == '/arm':"),
    ],
    "look_closer": [
        _closer("log.name + ", '"/arm" + '),
        _closer('"debug"', '"info"'),
        _closer('"rosout"', '"rospy"'),
        _closer(">= Log.ERROR", ">= Log.WARN"),
        _closer(">= Log.ERROR", "> Log.FATAL"),
    ],
}
