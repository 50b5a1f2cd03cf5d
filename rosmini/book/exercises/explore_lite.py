"""Checks of the exercises in the chapter explore_lite."""

from __future__ import annotations

import math
import re
from typing import Any

from rosmini.book.checks import Script, Wrong, exercise, expect, expect_type
from rosmini.book.trials import TurtleTrial
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.visualization_msgs.msg import Marker, MarkerArray

from .frontier_exploration import Flat

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


WORLD = """
define wall model( size [4.6 0.1 0.5] color "gray30" )
wall( pose [1.2 -1.05 0 0] )
wall( pose [1.2 2.25 0 0] )
wall( pose [-1.05 0.6 0 90] size [3.4 0.1 0.5] )
wall( pose [3.45 0.6 0 90] size [3.4 0.1 0.5] )
wall( pose [-0.75 1.25 0 0] size [0.5 0.1 0.5] )
wall( pose [1.15 1.25 0 0] size [1.7 0.1 0.5] )
wall( pose [2.05 1.3 0 90] size [1.8 0.1 0.5] )
wall( pose [2.05 -0.7 0 90] size [0.6 0.1 0.5] )
"""
"""The flat of the chapter."""
EXPLORE = '<include file="$(find explore_lite)/launch/explore.launch"/>'
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
def frontier_count(answer: Script) -> Any:
    """A node that reports how many frontiers are open, and how many were given up."""
    _check_reports(answer)
    with Flat(EXPLORE, WORLD) as flat:
        desk = flat.graph.node("customer")
        heard: list[str] = []
        shown: list[str] = []
        desk.subscriber("report", String, lambda message: heard.append(message.data))
        desk.subscriber("explore/frontiers", MarkerArray, lambda message: shown.append(_report_of(message)))
        flat.start(answer)
        flat.run(15.0)
        expect(
            bool(shown) and heard[-1:] == shown[-1:],
            f"The state of the frontiers is {shown[-1:]}, but your last report is {heard[-1:]}.",
            "publish one report for each message",
        )
        return flat.view()


def _check_reports(answer: Script) -> None:
    """Expect one report for each of several messages."""
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
                "count the markers of type POINTS; color.r is 1 if the frontier was given up",
            )


def _report_of(message: MarkerArray) -> str:
    """Return the report that belongs to a message."""
    lines = [one for one in message.markers if one.type == Marker.POINTS]
    red = sum(one.color.r == 1.0 for one in lines)
    return f"{len(lines) - red} open, {red} given up"


R = 0.05
"""Size of a cell [m]."""
DEFAULTS = {"potential_scale": 1e-3, "gain_scale": 1.0, "min_frontier_size": 0.5, "progress_timeout": 30.0}
"""Values of parameters that no launch file sets."""


def _cost(potential: float, gain: float, distance: float, length: float) -> float:
    return potential * distance * R - gain * length


@exercise("cautious", praise="The robot prefers short trips, and drives far only to long frontiers.")
def cautious(answer: Any) -> Any:
    """A launch file that starts `explore` with parameters that weigh distance and size as the task asks."""
    expect_type(answer, str, "launch is", "a text")
    tags = re.fullmatch(r"\s*<launch>(.*)</launch>\s*", answer, re.DOTALL)
    if tags is None:
        raise Wrong("The text does not begin with <launch> and end with </launch>.", "see near_first.launch")
    with Flat(tags[1], WORLD) as flat:
        expect("/explore" in flat.graph.nodes, "It starts no node /explore.", "include explore.launch")
        node = flat.graph.node("check")
        given = {name: float(node.get_param(f"/explore/{name}", default)) for name, default in DEFAULTS.items()}
        _check_weights(given["potential_scale"], given["gain_scale"])
        for name, wanted in (("min_frontier_size", 0.6), ("progress_timeout", 15.0)):
            expect(
                math.isclose(given[name], wanted),
                f"/explore/{name} is {given[name]:g}, not {wanted:g}.",
                "the table of parameters lists the names",
            )
        flat.run(20.0)
        return flat.view()


def _check_weights(potential: float, gain: float) -> None:
    """Expect weights that choose as the task asks."""
    expect(gain == 1, f"/explore/gain_scale is {gain:g}, not 1.", "explore.launch already sets it to 1")
    near, far = _cost(potential, gain, 2.0, 0.8), _cost(potential, gain, 5.0, 2.4)
    expect(
        near < far,
        f"With potential_scale {potential:g} the near frontier costs {near:+.2f}, the large one at 5 m {far:+.2f}.",
        "give the distance more weight",
    )
    middle = _cost(potential, gain, 3.0, 2.4)
    expect(
        middle < near,
        f"With potential_scale {potential:g} the near frontier costs {near:+.2f}, the large one at 3 m {middle:+.2f}.",
        "give the distance less weight",
    )
