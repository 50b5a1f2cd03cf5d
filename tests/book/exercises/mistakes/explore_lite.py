"""Wrong answers to the exercises of the chapter explore_lite: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

COUNTER = """
import rospy
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray


def on_frontiers(message):
    lines = [m for m in message.markers if m.type == Marker.POINTS]
    red = sum(m.color.r == 1.0 for m in lines)
    report.publish(f"{len(lines) - red} open, {red} given up")


rospy.init_node("counter")
report = rospy.Publisher("report", String, queue_size=1)
rospy.Subscriber("explore/frontiers", MarkerArray, on_frontiers)
rospy.spin()
"""


def _but(right: str, old: str, new: str) -> Callable[[], Script]:
    assert old in right, old
    return lambda: Script("answer.py", right.replace(old, new))


def _cheapest(*, above: bool = False, metres: bool = False, dearest: bool = False, of_large: bool = False) -> Any:
    def made() -> Any:
        def cheapest(frontiers: Any, potential: float, gain: float, least: float, r: float) -> Any:
            def cost(i: int) -> float:
                d, n = frontiers[i]
                return float(potential * d * (1 if metres else r) - gain * n * r)

            large = [i for i, (_, n) in enumerate(frontiers) if (n * r > least if above else n * r >= least)]
            found = (max if dearest else min)(large, key=cost, default=None)
            return large.index(found) if of_large and found is not None else found

        return cheapest

    return made


def _parameters(**changes: Any) -> Callable[[], dict[str, Any]]:
    right = {"gain_scale": 1.0, "potential_scale": 20.0, "min_frontier_size": 0.6, "progress_timeout": 15.0}
    return lambda: {name: value for name, value in {**right, **changes}.items() if value is not None}


MISTAKES = {
    "cheapest": [
        _cheapest(above=True),
        _cheapest(metres=True),
        _cheapest(dearest=True),
        _cheapest(of_large=True),
        lambda: lambda *_: 0,
    ],
    "frontier_count": [
        _but(COUNTER, " if m.type == Marker.POINTS", ""),
        _but(COUNTER, "if m.type == Marker.POINTS", "if m.type == Marker.SPHERE"),
        _but(COUNTER, "m.color.r == 1.0", "m.color.b == 1.0"),
        _but(COUNTER, "{len(lines) - red}", "{len(lines)}"),
        _but(COUNTER, '"report"', '"reports"'),
    ],
    "cautious": [
        _parameters(potential_scale=3.0),
        _parameters(potential_scale=40.0),
        _parameters(gain_scale=2.0),
        _parameters(min_frontier_size=None),
        _parameters(progress_timeout=30.0),
        _parameters(min_frontier_size=0.75),
        _parameters(potential_scale="20"),
        _parameters(orientation_scale=1.0),
    ],
}
