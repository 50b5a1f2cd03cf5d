"""Checks of the exercises in the chapter explore_lite."""

from __future__ import annotations

from typing import Any

from rosmini.book.checks import Script, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.visualization_msgs.msg import Marker, MarkerArray

Frontiers = list[tuple[float, int]]

CASES: tuple[tuple[Frontiers, tuple[float, float, float, float], int | None, str], ...] = (
    ([(1.0, 10), (2.0, 18), (6.0, 60)], (3.0, 1.0, 0.0, 0.05), 2, "the size outweighs the distance"),
    (
        [(1.0, 10), (2.0, 18), (6.0, 60)],
        (24.0, 1.0, 0.0, 0.05),
        0,
        "with a large potential_scale the near frontier is the cheapest",
    ),
    ([(1.0, 10), (2.0, 18), (6.0, 60)], (24.0, 1.0, 0.75, 0.05), 1, "frontiers that are too short are ignored"),
    ([(1.0, 10), (2.0, 15)], (3.0, 1.0, 0.75, 0.05), 1, "a frontier of exactly the minimum length is long enough"),
    ([(1.0, 10)], (3.0, 1.0, 0.75, 0.05), None, "no frontier is long enough"),
    ([], (3.0, 1.0, 0.0, 0.05), None, "there are no frontiers"),
    (
        [(3.0, 9), (1.0, 2)],
        (1.0, 0.5, 0.0, 1.0),
        0,
        "the distance is in metres and the size in cells; r converts cells to metres",
    ),
)


@exercise("cheapest", praise="This is the frontier that the greedy explorer chooses.")
def cheapest(answer: Any) -> None:
    """The index of the frontier with the lowest cost."""
    expect(callable(answer), f"cheapest is {answer!r}, not a function.", "write def cheapest(...): ...")
    for frontiers, numbers, wanted, why in CASES:
        found = answer(list(frontiers), *numbers)
        potential, gain, least, r = numbers
        said = (
            f"For {frontiers} with potential {potential}, gain {gain}, minimum {least} m and r {r} m it returned "
            f"{found!r}, not {wanted!r}."
        )
        expect(found == wanted and isinstance(found, bool) is False, said, why)


VIEWS = ("bb", "bbr", "b", "rrr", "", "rb")
"""The frontiers of each message: b is a blue one, r one that was given up."""
COLOURS = {"b": (0.0, 0.0, 1.0), "r": (1.0, 0.0, 0.0)}


def _markers(view: str, shown: int) -> MarkerArray:
    """The markers that `explore` publishes for `view`, and the deletions of `shown` older ones."""
    markers: list[Marker] = []
    for colour in view:
        for kind, rgb in ((Marker.POINTS, COLOURS[colour]), (Marker.SPHERE, (0.0, 1.0, 0.0))):
            marker = Marker(ns="frontiers", id=len(markers), type=kind, action=Marker.ADD)
            marker.color.r, marker.color.g, marker.color.b = rgb
            marker.color.a = 1.0
            markers.append(marker)
    for number in range(len(markers), shown):
        gone = Marker(ns="frontiers", id=number, type=Marker.SPHERE, action=Marker.DELETE)
        gone.color.b = 1.0
        markers.append(gone)
    return MarkerArray(markers=markers)


@exercise("frontier_count", praise="The last report of an exploration now says whether anything was given up.")
def frontier_count(answer: Script) -> None:
    """A node that reports how many frontiers are open, and how many were given up."""
    with TurtleTrial(None) as trial:
        node = trial.graph.node("explore")
        heard: list[str] = []
        node.subscriber("report", String, lambda message: heard.append(message.data))
        frontiers = node.publisher("explore/frontiers", MarkerArray, queue_size=5)
        trial.start(answer)
        trial.run(2.0)
        shown = 0
        for view in VIEWS:
            heard.clear()
            frontiers.publish(_markers(view, shown))
            trial.run(0.5)
            shown = 2 * len(view)
            wanted = [f"{view.count('b')} open, {view.count('r')} given up"]
            expect(
                heard == wanted,
                f"For {wanted[0]} it published {heard or 'nothing'} on report.",
                "count the markers of the type POINTS; color.r is 1 if the frontier was given up",
            )


R = 0.05
"""Size of a cell [m]."""


def _cost(potential: float, gain: float, distance: float, length: float) -> float:
    return potential * distance * R - gain * length


@exercise("cautious", praise="The robot prefers short trips, and drives far only to long frontiers.")
def cautious(answer: Any) -> None:
    """Parameters that weigh distance and size as the task asks."""
    expect_type(answer, dict, "parameters is", "a dictionary")
    known = {"gain_scale", "potential_scale", "min_frontier_size", "progress_timeout"}
    expect(
        answer.get("gain_scale") == 1, f"gain_scale is {answer.get('gain_scale')!r}, not 1.", "the task gives its value"
    )
    potential = answer.get("potential_scale")
    ok = isinstance(potential, int | float) and not isinstance(potential, bool)
    expect(ok, f"potential_scale is {potential!r}, not a number.", "it is a number between two bounds")
    near, far = _cost(potential, 1.0, 2.0, 0.8), _cost(potential, 1.0, 5.0, 2.4)
    expect(
        near < far,
        f"With potential_scale {potential:g} the near frontier costs {near:+.2f}, the large one at 5 m {far:+.2f}.",
        "give the distance more weight",
    )
    middle = _cost(potential, 1.0, 3.0, 2.4)
    expect(
        middle < near,
        f"With potential_scale {potential:g} the near frontier costs {near:+.2f}, the large one at 3 m {middle:+.2f}.",
        "give the distance less weight",
    )
    for name, wanted in (("min_frontier_size", 0.6), ("progress_timeout", 15)):
        expect(
            name in answer and answer[name] == wanted,
            f"{name} is {answer.get(name)!r}, not {wanted!r}.",
            "read the table of parameters",
        )
    others = sorted(set(answer) - known)
    expect(
        not others,
        f"{', '.join(map(str, others))} is not a parameter of explore that matters here.",
        "four parameters are enough",
    )
