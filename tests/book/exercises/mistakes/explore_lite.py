"""Wrong answers to the exercises of the chapter explore_lite: right ones with a fault put in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.book.checks import Script

from .file_system import wrong
from .published import solution

if TYPE_CHECKING:
    from collections.abc import Callable

COUNTER = solution("explore_lite", "frontier_count")


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


CAUTIOUS = """
<launch>
  <include file="$(find explore_lite)/launch/explore.launch"/>
  <param name="explore/potential_scale" value="20.0"/>
  <param name="explore/min_frontier_size" value="0.6"/>
  <param name="explore/progress_timeout" value="15.0"/>
</launch>
"""


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
        wrong(CAUTIOUS, "20.0", "3.0"),
        wrong(CAUTIOUS, "20.0", "40.0"),
        wrong(CAUTIOUS, "15.0", "30.0"),
        wrong(CAUTIOUS, '"0.6"', '"0.75"'),
        wrong(CAUTIOUS, '"explore/min_frontier_size"', '"min_frontier_size"'),
        wrong(CAUTIOUS, "</launch>", '<param name="explore/gain_scale" value="2.0"/></launch>'),
        wrong(CAUTIOUS, '  <include file="$(find explore_lite)/launch/explore.launch"/>\n'),
        wrong(CAUTIOUS, "</launch>"),
        lambda: {"potential_scale": 20.0},
    ],
}
