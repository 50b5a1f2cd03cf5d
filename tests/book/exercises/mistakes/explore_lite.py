"""Wrong answers to the exercises of the chapter explore_lite: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

if TYPE_CHECKING:
    from collections.abc import Callable

GUARD = """
import rospy
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool

rests = False


def on_battery(battery):
    global rests
    if battery.percentage < 0.2 and not rests:
        rests = True
        resume.publish(False)
    elif battery.percentage > 0.8 and rests:
        rests = False
        resume.publish(True)


rospy.init_node("guard")
resume = rospy.Publisher("explore/resume", Bool, queue_size=1)
rospy.Subscriber("battery_state", BatteryState, on_battery)
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
    right = {
        "gain_scale": 1.0,
        "potential_scale": 20.0,
        "min_frontier_size": 0.6,
        "progress_timeout": 15.0,
        "return_to_init": True,
    }
    return lambda: {name: value for name, value in {**right, **changes}.items() if value is not None}


MISTAKES = {
    "cheapest": [
        _cheapest(above=True),
        _cheapest(metres=True),
        _cheapest(dearest=True),
        _cheapest(of_large=True),
        lambda: lambda *_: 0,
    ],
    "battery_guard": [
        _but(GUARD, " and not rests", ""),
        _but(GUARD, " and rests", ""),
        _but(GUARD, "publish(False)", "publish(True)"),
        _but(GUARD, "> 0.8", "> 0.2"),
        _but(GUARD, "< 0.2", "< 0.5"),
        _but(GUARD, "explore/resume", "resume"),
    ],
    "cautious": [
        _parameters(potential_scale=3.0),
        _parameters(potential_scale=40.0),
        _parameters(gain_scale=2.0),
        _parameters(return_to_init=None),
        _parameters(progress_timeout=30.0),
        _parameters(min_frontier_size=0.75),
        _parameters(potential_scale="20"),
        _parameters(orientation_scale=1.0),
    ],
}
