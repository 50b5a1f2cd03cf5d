"""Wrong answers to the exercises of the chapter Threads and spin: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

BRAKE = """
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header

newest = None

def look(scan):
    rospy.sleep(0.5)
    looked.publish(scan.header)

def on_scan(scan):
    global newest
    newest = newest or scan if FIRST else scan
    if SLOW:
        look(scan)
    command = Twist()
    if min(scan.ranges[:20] + scan.ranges[-20:]) > 0.5:
        command.linear.x = 0.2
    cmd_vel.publish(command)

rospy.init_node("courier")
cmd_vel = rospy.Publisher("cmd_vel", Twist, queue_size=1)
looked = rospy.Publisher("looked", Header, queue_size=1)
rospy.Subscriber("scan", LaserScan, on_scan, queue_size=1)
while not rospy.is_shutdown():
    if newest and not SLOW:
        look(newest)
    else:
        rospy.sleep(0.1)
"""

LOAD = solution("threads_and_spin", "weight_on_board")

STEADY = solution("threads_and_spin", "steady")


def _changed(name: str, source: str, *changes: tuple[str, str]) -> Callable[[], Script]:
    for before, after in changes:
        assert before in source
        source = source.replace(before, after)
    return lambda: Script(f"{name}.py", source)


def _brake(*changes: tuple[str, str], first: bool = False, slow: bool = False) -> Callable[[], Script]:
    return _changed("brake_first", BRAKE, ("FIRST", str(first)), ("SLOW", str(slow)), *changes)


def _load(before: str, after: str) -> Callable[[], Script]:
    return _changed("load", LOAD, (before, after))


def _steady(before: str, after: str) -> Callable[[], Script]:
    return _changed("steady", STEADY, (before, after))


MISTAKES = {
    "brake_first": [
        _brake(slow=True),
        _brake(first=True),
        _brake((", queue_size=1)\nwhile", ")\nwhile"), slow=True),
        _brake(("look(newest)", "rospy.sleep(0.5)")),
        _brake(("rospy.sleep(0.5)", "rospy.sleep(0.1)")),
        _brake(("> 0.5", "> 0.2")),
        _brake(("> 0.5", "> 0.8")),
        _brake(("    cmd_vel.publish(command)\n", "")),
    ],
    "weight_on_board": [
        _load("threading.Lock()", "threading.Semaphore(9)"),
        _load("add(-weight.data)", "add(weight.data)"),
        _load("        on_board.publish(load)\n", ""),
        _load('"back_door"', '"rear_door"'),
        _load("load = new_load(load, change)\n        on_board", "on_board"),
    ],
    "steady": [
        _steady("Rate(10)", "Rate(5)"),
        _steady("> 2.0", "> 20.0"),
        _steady("> 2.0", "> 1.0"),
        _steady("rate.sleep()", "rospy.sleep(0.15)"),
        _steady("wish = Twist()", "continue"),
        _steady('"wish"', '"wishes"'),
    ],
}
