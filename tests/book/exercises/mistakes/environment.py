"""Wrong answers to the exercises of the chapter The environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

FAST = solution("environment", "fast")


def _fast(old: str, new: str) -> Callable[[], Script]:
    assert old in FAST
    return lambda: Script("fast.py", FAST.replace(old, new))


def _last(package: str, path: str, packages: dict[str, list[str]]) -> str | None:
    found = [folder for folder in path.split(":") if package in packages.get(folder, [])]
    return found[-1] if found else None


def _without_order(package: str, _path: str, packages: dict[str, list[str]]) -> str | None:
    return next((folder for folder, names in packages.items() if package in names), None)


def _beginning(package: str, path: str, packages: dict[str, list[str]]) -> str | None:
    for folder in path.split(":"):
        if any(name.startswith(package) for name in packages.get(folder, [])):
            return folder
    return None


def _fails(package: str, path: str, packages: dict[str, list[str]]) -> str | None:
    return next((folder for folder in path.split(":") if package in packages[folder]), None)


MODELS = ("burger", "waffle", "waffle_pi")


def _mending(
    ends: tuple[str, ...] = ("", "/"), models: tuple[str, ...] = MODELS, own: tuple[str, ...] = ("", "localhost")
) -> Callable[[], Any]:
    def wrong_variable(environment: dict[str, str]) -> str | None:
        if environment.get("ROS_MASTER_URI", "") not in [f"http://robot:11311{end}" for end in ends]:
            return "ROS_MASTER_URI"
        if environment.get("ROS_HOSTNAME", "") in own:
            return "ROS_HOSTNAME"
        return None if environment.get("TURTLEBOT3_MODEL") in models else "TURTLEBOT3_MODEL"

    return lambda: wrong_variable


MISTAKES: dict[str, list[Callable[[], Any]]] = {
    "fast": [
        _fast("0.22 if", "0.26 if"),
        _fast("else 0.26", "else 0.22"),
        _fast('os.environ.get("TURTLEBOT3_MODEL", "burger")', 'os.environ["TURTLEBOT3_MODEL"]'),
        _fast('model == "burger" else 0.26', 'model != "waffle" else 0.26'),
        _fast("command = Twist()", "command = Twist()\ncommand.angular.z = 0.1"),
        _fast("Duration(0.1)", "Duration(1.0)"),
        _fast("rospy.Timer(rospy.Duration(0.1), drive)", "drive(None)"),
    ],
    "winner": [
        lambda: _last,
        lambda: _without_order,
        lambda: _beginning,
        lambda: _fails,
        lambda: lambda *_: "~/report_ws/src",
    ],
    "wrong_variable": [
        _mending(ends=("",)),
        _mending(models=MODELS[:2]),
        _mending(models=(*MODELS, "burgr")),
        _mending(own=("",)),
        _mending(own=("localhost",)),
        lambda: lambda environment: None if "ROS_MASTER_URI" in environment else "ROS_MASTER_URI",
    ],
}
