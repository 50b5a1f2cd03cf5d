"""Several robots that cross one another's paths: each is sent to where another one began, all at once.

The whole stack with amcl is started by `rosmini_sim multi_navigation.launch`, as a user starts it. A contact is charged
to each of the two that moved, when it began, faster than `STILL`.
"""

from __future__ import annotations

import io
import math
import statistics
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import numpy as np

from rosmini.core.graph import Graph
from rosmini.core.time import Time
from rosmini.msgs import message_class
from rosmini.navigation.nav_core import pose_stamped
from rosmini.ros.launch import roslaunch

from .nav_goals import wilson

STILL = 0.02
"""Who goes no faster [m/s] was touched, and did not touch."""
LOOK = 0.02
"""How often it is asked who touches what [s]."""
PATIENCE = 240.0
"""A robot that has no result by then has failed [s]."""
XY, YAW = 0.25, 0.3
"""What a true pose may be off [m, rad]: the tolerances of the file, and what amcl may be off."""


@dataclass(frozen=True)
class Crossing:
    """What came of one run."""

    robots: int
    seed: int
    reached: int
    """Of the robots."""
    failures: tuple[str, ...]
    charged: tuple[str, ...]
    """Who drove into what."""
    seconds: float
    """Until the last result."""
    cpu: float


@dataclass
class _Watch:
    """Who touches what, and who is charged with it."""

    engine: Any
    touching: frozenset[tuple[str, str]] = frozenset()
    charged: list[str] = field(default_factory=list)

    def look(self, _: Any = None) -> None:
        """Charge those who move with what is newly touched."""
        now = set()
        for robot in self.engine.robots:
            speed = abs(self.engine.velocity(robot)[0])
            for touch in self.engine.touching(robot):
                now.add((robot, touch.other))
                if (robot, touch.other) not in self.touching and speed > STILL:
                    self.charged.append(f"{robot} into {touch.other}")
        self.touching = frozenset(now)


def destinations(count: int, seed: int) -> list[int]:
    """Of each robot the one to whose start it is sent: nobody stays, drawn by the seed."""
    draw = np.random.default_rng(seed)
    while True:
        found = draw.permutation(count)
        if (found != np.arange(count)).all():
            return [int(each) for each in found]


def run(robots: int, seed: int) -> Crossing:
    """Send all robots at once."""
    quiet = {"stdout": io.StringIO(), "stderr": io.StringIO()}
    graph = Graph(strict=False, seed=seed)
    try:
        roslaunch("rosmini_sim", "multi_navigation.launch", f"robots:={robots}", graph=graph, console=quiet)
        return _run(graph, robots, seed)
    finally:
        graph.shutdown()


def _run(graph: Graph, robots: int, seed: int) -> Crossing:
    names = [f"tb3_{number}" for number in range(robots)]
    node = graph.node("tester")
    results: dict[str, Any] = {}
    goals: dict[str, Any] = {}
    for name in names:
        result = message_class("move_base_msgs/MoveBaseActionResult")
        node.subscriber(
            f"/{name}/move_base/result", result, lambda message, name=name: results.setdefault(name, message)
        )
        posed = message_class("geometry_msgs/PoseStamped")
        goals[name] = node.publisher(f"/{name}/move_base_simple/goal", posed, queue_size=1)
    graph.run(3.0)
    engine = graph.nodes["/simulator"].program.engine
    watch = _Watch(engine)
    node.timer(LOOK, watch.look)
    targets = [engine.pose(names[index]) for index in destinations(robots, seed)]
    begin, cpu = graph.scheduler.now_ns(), time.process_time()
    for name, target in zip(names, targets, strict=True):
        goals[name].publish(pose_stamped("map", Time(0), target))
    while len(results) < robots and (graph.scheduler.now_ns() - begin) * 1e-9 < PATIENCE:
        graph.run(1.0)
    cpu = time.process_time() - cpu
    failures = []
    for name, target in zip(names, targets, strict=True):
        x, y, yaw = engine.pose(name)
        off = math.dist((x, y), target[:2]) > XY or abs(math.remainder(yaw - target[2], math.tau)) > YAW
        if name not in results:
            failures.append("no result")
        elif results[name].status.status != 3 or off:
            failures.append("off in truth" if results[name].status.status == 3 else results[name].status.text)
    seconds = (graph.scheduler.now_ns() - begin) * 1e-9
    return Crossing(robots, seed, robots - len(failures), tuple(failures), tuple(watch.charged), seconds, cpu)


def table(found: Iterable[Crossing]) -> Iterator[str]:
    """One line of Markdown for each number of robots."""
    yield "| robots | runs | reached | 95% interval | contacts | all ended after | what went wrong |"
    yield "|---|---|---|---|---|---|---|"
    for robots, group in groupby(sorted(found, key=lambda one: (one.robots, one.seed)), lambda one: one.robots):
        runs = list(group)
        reached = sum(one.reached for one in runs)
        low, high = wilson(reached, robots * len(runs))
        why = Counter(each for one in runs for each in (*one.failures, *one.charged))
        yield (
            f'| <a id="crossing-{robots}"></a>{robots} | {len(runs)} | {reached} of {robots * len(runs)} | '
            f"{low:.0%} to {high:.0%} | {sum(len(one.charged) for one in runs)} in "
            f"{sum(bool(one.charged) for one in runs)} of {len(runs)} runs | "
            f"{statistics.median(one.seconds for one in runs):.0f} s | "
            f"{'; '.join(f'{times} x {what}' for what, times in why.most_common())} |"
        )
