"""Wrong answers to the exercises of the chapter When things go wrong: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

GREET = solution("when_things_go_wrong", "greet")

WATCHDOG = solution("when_things_go_wrong", "watchdog")

DOCTOR = """
import rosgraph

publishers, subscribers, services = rosgraph.Master("/doctor").getSystemState()
published = [topic for topic, nodes in publishers]
for topic, nodes in sorted(subscribers):
    if topic not in published:
        print(topic)
"""


def wrong(name: str, right: str, old: str = "", new: str = "") -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script(name, right.replace(old, new))


MISTAKES = {
    "greet": [
        wrong("greet.py", GREET, ", latch=True"),
        wrong("greet.py", GREET, '"greeting"', '"greetings"'),
        wrong("greet.py", GREET, '"hello"', '"hallo"'),
        wrong("greet.py", GREET, "rospy.spin()", "while True:\n    rospy.sleep(0.5)\n    greeting.publish('hello')"),
        wrong("greet.py", GREET, "rospy.spin()", ""),
        wrong(
            "greet.py",
            GREET.replace(", latch=True", ""),
            "rospy.spin()",
            "while True:\n    rospy.sleep(1)\n    greeting.publish('hello')",
        ),
    ],
    "watchdog": [
        wrong("watchdog.py", WATCHDOG, "- last > 1.0", "- last > 5.0"),
        wrong("watchdog.py", WATCHDOG, "- last > 1.0", "- last > 0.1"),
        wrong("watchdog.py", WATCHDOG, "- last > 1.0", "- last < 1.0"),
        wrong("watchdog.py", WATCHDOG, "- last > 1.0", "- last > 0.5"),
        wrong("watchdog.py", WATCHDOG, '"scan"', '"scam"'),
        wrong("watchdog.py", WATCHDOG, "    global last\n"),
        wrong("watchdog.py", WATCHDOG, "rospy.Timer(rospy.Duration(0.2), look)"),
    ],
    "doctor": [
        wrong("doctor.py", DOCTOR, "if topic not in", "if topic in"),
        wrong("doctor.py", DOCTOR, "sorted(subscribers)", "publishers"),
        wrong("doctor.py", DOCTOR, "sorted(subscribers)", "sorted(subscribers, reverse=True)"),
        wrong("doctor.py", DOCTOR, "    if topic not in published:\n        print", "    print"),
        wrong("doctor.py", DOCTOR, "print(topic)", "print(topic, nodes)"),
    ],
}
