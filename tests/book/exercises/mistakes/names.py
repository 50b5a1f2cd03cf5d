"""Wrong answers to the exercises of the chapter Names: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

REPORT = solution("names", "report")

DANCE = solution("names", "dance")


def wrong(name: str, right: str, old: str, new: str) -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script(name, right.replace(old, new))


MISTAKES = {
    "arguments": [
        lambda: "__ns:=/amy __name:=courier",
        lambda: ["__ns:=/amy", "__name:=courier", "cmd_vel:=/amy/wheels/cmd_vel", "_speed:=0.15"],
        lambda: ["__ns:=/amy", "__name:=courier", "cmd_vel:=wheels/cmd_vel", "speed:=0.15"],
        lambda: ["__ns:=/amy", "__name:=courier", "cmd_vel:=wheels/cmd_vel"],
        lambda: ["__ns:=/amy", "__name:=courier", "_speed:=0.15"],
        lambda: ["__ns:=/amy", "cmd_vel:=wheels/cmd_vel", "_speed:=0.15"],
        lambda: ["__name:=courier", "cmd_vel:=wheels/cmd_vel", "_speed:=0.15"],
        lambda: ["__ns:=/amy", "__name:=courier", "cmd-vel:=wheels/cmd_vel", "_speed:=0.15"],
        list,
    ],
    "report": [
        wrong("report.py", REPORT, '"/report"', '"report"'),
        wrong("report.py", REPORT, '"scan"', '"/scan"'),
        wrong("report.py", REPORT, '"scan"', '"/amy/scan"'),
        wrong("report.py", REPORT, '.rstrip("/")', ""),
        wrong("report.py", REPORT, "get_namespace", "get_name"),
        wrong("report.py", REPORT, ":.2f", ":.1f"),
        wrong("report.py", REPORT, "ranges[0]", "ranges[180]"),
        wrong("report.py", REPORT, "rospy.spin()", ""),
    ],
    "dance": [
        wrong("dance.py", DANCE, 'robot + "/cmd_vel"', '"cmd_vel"'),
        wrong("dance.py", DANCE, 'robot + "/cmd_vel"', '"/amy/cmd_vel"'),
        wrong("dance.py", DANCE, 'if topic.endswith("/scan")', 'if topic == "/amy/scan"'),
        wrong("dance.py", DANCE, "angular.z = 1.0", "linear.x = 0.2"),
        wrong("dance.py", DANCE, 'removesuffix("/scan")', 'split("/")[1]'),
        wrong("dance.py", DANCE, "for publisher in publishers:\n        publisher.publish", "publishers[0].publish"),
    ],
}
