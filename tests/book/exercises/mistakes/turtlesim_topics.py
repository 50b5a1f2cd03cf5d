"""Wrong answers to the exercises of the chapter turtlesim: topics: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

TRIANGLE = solution("turtlesim_topics", "triangle")

MIRROR = solution("turtlesim_topics", "mirror")


def _script(text: str, old: str, new: str) -> Callable[[], Script]:
    assert old in text
    return lambda: Script("answer.py", text.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "corner": [
        lambda: "DAAA",
        lambda: "CAAA",
        lambda: "CCAAAA",
        lambda: "CCAA",
        lambda: "CDCDCCAAA",
        lambda: "XYZ",
        lambda: 61,
    ],
    "triangle": [
        _script(TRIANGLE, "pen(255, 0, 0, 5, 1)\n", ""),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(255, 0, 0, 3, 0)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(0, 255, 0, 5, 0)"),
        _script(TRIANGLE, ", (2, 2):", ":"),
        _script(TRIANGLE, "jump(x, y, 0)", "jump(x, y)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)", "pen(256, 0, 0, 5, 0)"),
        _script(TRIANGLE, "(5.5, 8)", "(5, 8)"),
        _script(TRIANGLE, "pen(255, 0, 0, 5, 0)\n", ""),
    ],
    "mirror": [
        _script(MIRROR, "-pose.angular_velocity", "pose.angular_velocity"),
        _script(MIRROR, "= pose.linear_velocity", "= -pose.linear_velocity"),
        _script(MIRROR, '"cmd_vel"', '"turtle2/cmd_vel"'),
        _script(MIRROR, "-pose.angular_velocity", "-2 * pose.angular_velocity"),
        _script(MIRROR, "-pose.angular_velocity", "-pose.theta"),
        _script(MIRROR, "    commands.publish(twist)\n", ""),
    ],
}
