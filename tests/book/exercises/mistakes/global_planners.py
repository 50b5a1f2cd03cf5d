"""Wrong answers to the exercises of the chapter Global planners: right ones with a fault put in."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .file_system import wrong
from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

TUNED = """
base_global_planner: global_planner/GlobalPlanner
GlobalPlanner:
  neutral_cost: 100
  cost_factor: 0.8
"""

NEAREST = solution("global_planners", "first_delivery")


def _but(old: str, new: str) -> Callable[[], Script]:
    assert old in NEAREST, old
    return lambda: Script("nearest.py", NEAREST.replace(old, new))


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
    "tuned": [
        *(wrong(TUNED, "0.8", factor) for factor in ("0.01", "3.0", "5.0", "66", "much")),
        wrong(TUNED, "100", "66"),
        wrong(TUNED, "global_planner/GlobalPlanner", "navfn/NavfnROS"),
        lambda: 0.8,
    ],
    "first_delivery": [
        _but("        return inf", "        return 0"),
        _but("min(stops", "max(stops"),
        _but("min(stops, key=length)", "stops[0]"),
        _but(
            "sum(hypot(b.x - a.x, b.y - a.y) for a, b in pairs)",
            "hypot(points[-1].x - points[0].x, points[-1].y - points[0].y)",
        ),
        _but("PoseStamped(header, pose)", "PoseStamped(pose=pose)"),
        _but("        goals.publish(nearest)", "        pass"),
        _but("    if length(nearest) < inf:", "    if stops:"),
    ],
}
