"""Wrong answers to the exercises of the chapter Logo: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

POLYGON = "to polygon :sides :length\nrepeat :sides [forward :length right 360 / :sides]\nend"

STAIRS = (
    "to stairs :count :size\nif :count = 0 [stop]\nforward :size right 90\nforward :size left 90\n"
    "stairs :count - 1 :size * 0.75\nend"
)

VISIT = (
    "to visit :places\nforeach :places [setheading towards ? forward distance ?]\nsetheading towards [0 0] home\nend"
)

TINY = """
import math

import rospy
from std_msgs.msg import String
from turtlesim.srv import TeleportRelative


def obey(message):
    try:
        word, text = message.data.split()
        amount = float(text)
    except ValueError:
        return
    if word == "forward":
        teleport(amount / 45, 0)
    elif word == "right":
        teleport(0, -math.radians(amount))


rospy.init_node("tiny_logo")
teleport = rospy.ServiceProxy("turtle1/teleport_relative", TeleportRelative)
rospy.Subscriber("logo", String, obey)
rospy.spin()
"""


def _text(right: str, old: str, new: str) -> Callable[[], str]:
    assert old in right
    return lambda: right.replace(old, new)


def _script(old: str, new: str) -> Callable[[], Script]:
    assert old in TINY
    return lambda: Script("tiny_logo.py", TINY.replace(old, new))


MISTAKES: dict[str, list[Callable[[], object]]] = {
    "polygon": [
        _text(POLYGON, "360 / :sides", "90"),
        _text(POLYGON, "360 / :sides", "180 - 360 / :sides"),
        _text(POLYGON, ":length right", "50 right"),
        _text(POLYGON, "repeat :sides", "repeat :sides - 1"),
        _text(POLYGON, "polygon", "poligon"),
        _text(POLYGON, "end", ""),
        lambda: 4,
    ],
    "stairs": [
        _text(STAIRS, "if :count = 0 [stop]\n", ""),
        _text(STAIRS, "0.75", "0.7"),
        _text(STAIRS, ":count = 0", ":count = 1"),
        _text(STAIRS, "forward :size right 90\nforward :size left 90", "right 90 forward :size left 90\nforward :size"),
        lambda: (
            "; stairs by stairs\nto stairs :count :size\nrepeat :count [forward :size right 90 forward :size left 90 "
            'make "size :size * 0.75]\nend'
        ),
    ],
    "visit": [
        _text(VISIT, "setheading towards ? forward distance ?", "setpos ?"),
        _text(VISIT, "setheading towards [0 0] home", ""),
        _text(VISIT, "distance ?", "100"),
        _text(VISIT, "setheading towards ? forward", "setheading 180 + towards ? back"),
        lambda: f"{VISIT.replace('visit', 'go')}\nto visit :p\ngo [[60 0] [60 80] [0 80]]\nend",
    ],
    "tiny_logo": [
        _script("-math", "math"),
        _script("/ 45", "/ 50"),
        _script("except ValueError:\n        return", "except KeyError:\n        return"),
        _script('"logo"', '"commands"'),
        _script("rospy.spin()", ""),
        _script("math.radians(amount)", "amount"),
    ],
}
