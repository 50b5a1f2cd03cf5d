"""Wrong answers to the exercises of the chapter Many machines: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

BASHRC = """
export ROS_MASTER_URI=http://192.168.1.10:11311
export ROS_IP=192.168.1.42
"""

CAUSES = {"Ada": "master", "Ben": "clock", "Cem": "address", "Dea": "name"}

MIRROR = solution("many_machines", "other_way_round")


def _lines(old: str, new: str) -> Callable[[], str]:
    assert old in BASHRC
    return lambda: BASHRC.replace(old, new)


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in MIRROR
    return lambda: Script("answer.py", MIRROR.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "bashrc": [
        _lines("192.168.1.10", "localhost"),
        _lines("192.168.1.10", "192.168.1.42"),
        _lines("http://", ""),
        _lines(":11311", ":eleven"),
        _lines("export ROS_IP", "ROS_IP"),
        _lines("IP=192", "IP = 192"),
        _lines("ROS_IP=192.168.1.42", "ROS_IP=192.168.1.10"),
        _lines("export ROS_MASTER", "echo export ROS_MASTER"),
        lambda: f"{BASHRC}export ROS_HOSTNAME=tablet",
        _lines("export ROS_IP=192.168.1.42", ""),
        _lines("192.168.1.42", '"192.168.1.42'),
        lambda: ["ROS_IP"],
    ],
    "causes": [
        lambda: CAUSES | {"Ada": "address"},
        lambda: CAUSES | {"Cem": "master"},
        lambda: CAUSES | {"Dea": 4},
        lambda: {"Ada": "master"},
        lambda: "clock",
    ],
    "other_way_round": [
        _script("-command", "command"),
        _script("other.linear = command.linear", "pass"),
        _script("mirrored.publish(other)", "pass"),
        _script('"/two/', '"/one/two/'),
        _script('("mirror")', '("looking_glass")'),
    ],
}
