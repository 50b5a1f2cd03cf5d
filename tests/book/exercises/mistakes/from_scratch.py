"""Wrong answers to the exercises of the chapter From scratch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

CMAKE = """
cmake_minimum_required(VERSION 3.0.2)
project(survey)
find_package(catkin REQUIRED COMPONENTS rospy geometry_msgs message_generation)
add_message_files(FILES Spot.msg)
add_service_files(FILES Visit.srv)
generate_messages(DEPENDENCIES geometry_msgs)
catkin_package(CATKIN_DEPENDS message_runtime)
"""

OBEY = solution("from_scratch", "obey")

PARROT = solution("from_scratch", "parrot")


def wrong(right: str, old: str, new: str = "") -> Callable[[], str]:
    """Return what makes a text with one place of it changed."""
    assert old in right
    return lambda: right.replace(old, new)


def script(right: str, old: str, new: str = "") -> Callable[[], Script]:
    """Return what makes a script with one place of it changed."""
    assert old in right
    return lambda: Script("answer.py", right.replace(old, new))


MISTAKES = {
    "cures": [lambda: {1: "c", 2: "a", 3: "b", 4: "e"}, lambda: {1: "c", 2: "a"}, lambda: "caeb"],
    "package_with_types": [
        wrong(CMAKE, " message_generation"),
        wrong(CMAKE, "Spot.msg", "Spots.msg"),
        wrong(CMAKE, "add_service_files(FILES Visit.srv)\n"),
        wrong(CMAKE, "add_message_files(FILES Spot.msg)\n"),
        wrong(CMAKE, "generate_messages(DEPENDENCIES geometry_msgs)\n"),
        wrong(CMAKE, "(DEPENDENCIES geometry_msgs)", "()"),
        wrong(CMAKE, "project(survey)", "project(servey)"),
        wrong(CMAKE, CMAKE, "catkin"),
        lambda: ["project(survey)"],
    ],
    "obey": [
        script(OBEY, "-0.5", "0.5"),
        script(OBEY, '"left"', '"Left"'),
        script(OBEY, "    cmd_vel.publish(command)\n"),
        script(OBEY, "0.1", "-0.1 if False else 0.0"),
        script(OBEY, "    cmd_vel.publish", "    if order.data != 'dance':\n        cmd_vel.publish"),
        script(OBEY, "order.data", "order.word"),
    ],
    "parrot": [
        script(PARROT, ", anonymous=True"),
        script(PARROT, "echo.publish", "print"),
        script(PARROT, "echo.publish", "lambda message: echo.publish(message.data.upper())"),
        script(PARROT, "rospy.spin()\n"),
    ],
}
