"""Wrong answers to the exercises of the chapter Many TurtleBots."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from rosmini.book.exercises.many_turtlebots import Choices, Command, _best, _drive, _ends, _twist
from rosmini.core.graph import Graph
from rosmini.core.tf import Buffer
from rosmini.msgs import message_class
from rosmini.sim.simulator import Simulator

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

Words = list[str]


# ---- spawn_words: one more robot ----


def _spawning(change: Callable[[Words], Words]) -> Callable[[], Any]:
    def words(name: str, x: float, y: float, yaw: float) -> Words:
        given = f"-urdf -model {name} -x {x} -y {y} -z 0.0 -Y {yaw} -param robot_description __ns:=/{name}"
        return change(given.split())

    return lambda: words


def _without(words: Words, option: str) -> Words:
    at = words.index(option)
    return words[:at] + words[at + 2 :]


# ---- follow: follow me ----


def _follower(
    law: Callable[[float], float], *, half: int = 20, who: str = "", everywhere: bool = False
) -> Callable[[], Any]:
    """A node that looks into a sector ahead and goes as `law` says."""

    def follow(graph: Graph, robot: str) -> None:
        node = graph.node("follow", namespace=who or robot)
        cmd_vel = node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)

        def look(scan: Any) -> None:
            front = np.concatenate([scan.ranges[-half:], scan.ranges[: half + 1]])
            cmd_vel.publish(_twist(law(float((scan.ranges if everywhere else front).min()))))

        node.subscriber("scan", message_class("sensor_msgs/LaserScan"), look)

    return lambda: follow


def _keep(room: float) -> float:
    return float(np.clip(room - 0.4, -0.1, 0.2)) if room < 1.0 else 0.0


# ---- seen_from: seen from another robot ----


def _looking(source: str, target: str) -> Callable[[], Any]:
    """The distance and bearing of one frame in another one; `{a}` stands for the robot, `{b}` for the other."""

    def seen_from(buffer: Buffer, robot: str, other: str) -> tuple[float, float]:
        frame, what = (text.format(a=robot, b=other) for text in (target, source))
        place = buffer.lookup_transform(frame, what).transform.translation
        return math.hypot(place.x, place.y), math.atan2(place.y, place.x)

    return lambda: seen_from


def _in_degrees() -> Any:
    right: Callable[..., tuple[float, float]] = _looking("{b}/base_footprint", "{a}/base_scan")()

    def seen_from(*given: Any) -> tuple[float, float]:
        distance, bearing = right(*given)
        return distance, math.degrees(bearing)

    return seen_from


def _on_paper(_graph: Graph, sim: Simulator, choices: Choices, goal: Sequence[float]) -> Command:
    """By arithmetic, as if nothing were in the way."""
    x, y, heading = sim.truth("tb3_0")

    def far(choice: tuple[float, float]) -> float:
        v, w = choice
        turned = heading + 1.5 * w
        return math.dist((x + 3 * v * math.cos(turned), y + 3 * v * math.sin(turned)), goal)

    return min(choices, key=far)


def _forgetful(graph: Graph, sim: Simulator, choices: Choices, goal: Sequence[float]) -> Command:
    far = _ends(graph, sim, choices, goal, back=False)
    return choices[far.index(min(far))]


def _and_go(graph: Graph, sim: Simulator, choices: Choices, goal: Sequence[float]) -> Command:
    best = _best(graph, sim, choices, goal)
    _drive(graph, "tb3_0/cmd_vel", *best, 3.0)
    return best


MISTAKES = {
    "spawn_words": [
        _spawning(lambda words: words[:-1]),
        _spawning(lambda words: _without(words, "-Y")),
        _spawning(lambda words: _without(words, "-x")),
        _spawning(lambda words: words[1:]),
        _spawning(lambda words: [*words[:-1], "__ns:=/tb3_2"]),
        _spawning(lambda words: [*words[:2], "tb3_2", *words[3:]]),
        lambda: lambda name, x, y, yaw: f"-urdf -model {name} -x {x} -y {y} -Y {yaw}",
        _spawning(lambda words: [*_without(words, "-Y"), "-Y", "90"]),
    ],
    "follow": [
        _follower(lambda _: 0.1),
        _follower(lambda _: 0.0),
        _follower(lambda room: float(np.clip(room - 0.4, -0.1, 0.2))),
        _follower(lambda room: 0.2 if room < 1.0 else 0.0),
        _follower(lambda room: -_keep(room)),
        _follower(_keep, everywhere=True),
        _follower(_keep, who="back"),
    ],
    "seen_from": [
        _looking("{a}/base_footprint", "{b}/base_scan"),
        _looking("{b}/base_footprint", "{a}/base_footprint"),
        _looking("{b}/base_footprint", "map"),
        _looking("{b}/odom", "{a}/base_scan"),
        _looking("tb3_1/base_footprint", "tb3_0/base_scan"),
        _in_degrees,
        lambda: lambda _buffer, _robot, _other: 1.0,
    ],
    "rehearse": [
        lambda: _on_paper,
        lambda: _forgetful,
        lambda: _and_go,
        lambda: lambda _graph, _sim, choices, _goal: choices[0],
        lambda: lambda _graph, _sim, choices, _goal: choices[-1],
        lambda: lambda graph, sim, choices, goal: min(_ends(graph, sim, choices, goal, back=True)),
    ],
}
