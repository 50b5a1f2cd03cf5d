"""Wrong answers to the exercises of the chapter Global planners: right ones with a fault put in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

FAR = """
from math import hypot

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.srv import GetPlan
from std_msgs.msg import Float64


def on_question(goal):
    plan = make_plan(PoseStamped(), goal, 0.5).plan.poses
    points = [each.pose.position for each in plan]
    pairs = zip(points, points[1:])
    length = sum(hypot(b.x - a.x, b.y - a.y) for a, b in pairs)
    distance.publish(length if plan else -1.0)


rospy.init_node("far")
rospy.wait_for_service("move_base/make_plan")
make_plan = rospy.ServiceProxy("move_base/make_plan", GetPlan)
distance = rospy.Publisher("distance", Float64, queue_size=1)
rospy.Subscriber("question", PoseStamped, on_question)
rospy.spin()
"""


def _but(old: str, new: str) -> Callable[[], Script]:
    assert old in FAR, old
    return lambda: Script("answer.py", FAR.replace(old, new))


def _guess(count: Callable[[int, int], float], *, priced: bool = True) -> Callable[[], Any]:
    def guess(cell: tuple[int, int], goal: tuple[int, int], cheapest: float) -> float:
        return (cheapest if priced else 1) * count(abs(goal[0] - cell[0]), abs(goal[1] - cell[1]))

    return lambda: guess


MISTAKES = {
    "guess": [
        _guess(lambda dx, dy: dx + dy),
        _guess(math.hypot),
        _guess(max),
        _guess(lambda dx, dy: max(dx, dy) + 0.414 * min(dx, dy), priced=False),
        _guess(lambda dx, dy: abs(dx - dy) + 2 * min(dx, dy)),
        _guess(lambda dx, dy: 0),
        lambda: lambda cell, goal, cheapest: "far",
    ],
    "trap": [
        lambda: "S........G",
        lambda: "....\nS::G\n....",
        lambda: "S::::::::G",
        lambda: "S#G",
        lambda: "..........\nS::::::::\n..........",
        lambda: "..........\nS:::::::xG\n..........",
        lambda: "." * 31 + "\nS" + ":" * 29 + "G",
        lambda: "",
        lambda: ["..........", "S::::::::G", ".........."],
    ],
    "tuned": [lambda: 0.01, lambda: 0.3, lambda: 2.0, lambda: 3.0, lambda: 5.0, lambda: 0, lambda: 66, lambda: "0.55"],
    "far": [
        _but("0.5)", "0.0)"),
        _but("make_plan(PoseStamped(),", "make_plan(goal,"),
        _but("goal, 0.5", "PoseStamped(), 0.5"),
        _but("length if plan else -1.0", "length"),
        _but("length if plan else -1.0", "len(plan) if plan else -1.0"),
        _but("hypot(b.x - a.x, b.y - a.y)", "abs(b.x - a.x) + abs(b.y - a.y)"),
        _but("    distance.publish(length if plan else -1.0)\n", ""),
        _but("    distance.publish(length if plan else -1.0)", "    if plan:\n        distance.publish(length)"),
        _but("zip(points, points[1:])", "[(points[0], points[-1])] if points else []"),
    ],
}
