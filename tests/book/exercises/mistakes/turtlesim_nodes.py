"""Wrong answers to the exercises of the chapter turtlesim: nodes: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

FROG = "rosrun turtlesim turtlesim_node __ns:=/pond __name:=frog _background_r:=0"

CENSUS = solution("turtlesim_nodes", "census")

GUARD = solution("turtlesim_nodes", "go_home")


def _command(old: str, new: str) -> Callable[[], str]:
    assert old in FROG
    return lambda: FROG.replace(old, new)


def _script(text: str, old: str, new: str) -> Callable[[], Script]:
    assert old in text
    return lambda: Script("answer.py", text.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "frog": [
        _command("__ns:=/pond ", ""),
        _command("__name", "--name"),
        _command("_background_r:=0", "background_r:=0"),
        _command("frog", "/pond/frog"),
        _command("rosrun", "roslaunch"),
        _command("_background_r:=0", "_background_r:= 0"),
        _command("__name:=frog", "__name:='frog"),
        _command("__ns", "_ns"),
        lambda: 60,
    ],
    "census": [
        _script(CENSUS, "sorted(count)", "count"),
        _script(CENSUS, 'if name != "/rosout":', "if True:"),
        _script(CENSUS, "in publishers", "in subscribers"),
        _script(CENSUS, "for name in nodes:", "for name in nodes * (_topic != '/rosout'):"),
        _script(CENSUS, "count.get(name, 0) + 1", "1"),
    ],
    "go_home": [
        _script(GUARD, " or abs(pose.y - 5.5) > 2", ""),
        _script(GUARD, "abs(pose.x - 5.5)", "(pose.x - 5.5)"),
        _script(GUARD, 'rospy.signal_shutdown("there is nothing left to guard")', "pass"),
        _script(GUARD, 'rospy.loginfo("the turtle has left")', "pass"),
        _script(GUARD, "> 2 or", "> 1 or"),
        _script(GUARD, "rospy.loginfo(", "print("),
        _script(GUARD, " or ", " and "),
        _script(GUARD, 'rospy.signal_shutdown("there is nothing left to guard")', "raise SystemExit"),
        _script(GUARD, '"guard"', '"guardian"'),
    ],
}
