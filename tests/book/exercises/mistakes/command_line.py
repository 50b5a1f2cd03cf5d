"""Wrong answers to the exercises of the chapter The command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

COMMANDS = {
    "Does /simulator answer?": "rosnode ping",
    "How many messages per second arrive on /imu?": "rostopic hz",
    "Which topics carry nav_msgs/Odometry?": "rostopic find",
    "Which fields does sensor_msgs/Imu have?": "rosmsg show",
    "Which arguments does /driver/set_logger_level take?": "rosservice args",
    "How do I save all parameters in a file?": "rosparam dump",
    "How long is drive.bag?": "rosbag info",
}

FOUND = {"type": "sensor_msgs/JointState", "rate": 30, "frame": "odom", "service": "roscpp/SetLoggerLevel"}

COUNT = solution("command_line", "count")


def _count(old: str, new: str) -> Callable[[], Script]:
    assert old in COUNT
    return lambda: Script("count.py", COUNT.replace(old, new))


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "commands": [
        dict,
        lambda: {**COMMANDS, "Does /simulator answer?": "rosnode list"},
        lambda: {**COMMANDS, "Which fields does sensor_msgs/Imu have?": "rosmmsg show"},
        lambda: {**COMMANDS, "How long is drive.bag?": "rosbag"},
        lambda: list(COMMANDS.values()),
    ],
    "ask_the_robot": [
        dict,
        lambda: {**FOUND, "rate": 5},
        lambda: {**FOUND, "rate": "30"},
        lambda: {**FOUND, "frame": "base_scan"},
        lambda: {**FOUND, "type": "sensor_msgs/Imu"},
        lambda: {**FOUND, "service": "std_srvs/Empty"},
        lambda: "30",
    ],
    "count": [
        _count("    beats.clear()\n", ""),
        _count("Duration(1)", "Duration(2)"),
        _count('"beat", Empty, beats.append', '"bead", Empty, beats.append'),
        _count("    rate.publish(len(beats))", "    if beats:\n        rate.publish(len(beats))"),
        _count("len(beats)", "5"),
    ],
}
