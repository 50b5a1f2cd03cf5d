"""Robots driven in a graph with every topic heard at its real rate: the basis of the simulator's figures."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.models import BURGER
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import World

from . import sim_room
from .sim_checks import READERS, Heard, Row, check_run, transforms

COMMAND_RATE = 10
"""So often a robot is told what to do [Hz]."""

PIECE = 2.0
"""So much is simulated at a time [s]; the first piece is not counted."""


class Run:
    """`count` TurtleBot3 in a world, each driven, and a subscriber on each of their topics that reads every message.

    The first has its topics without a namespace, each of the others in one of its own; all publish on one /tf.
    """

    def __init__(self, graph: Graph, count: int, world: World | None = None) -> None:
        self.graph = graph
        self.world = world or sim_room.room()
        starts = sim_room.starts(count)
        node = graph.node("simulator")
        for name, value in zip(("x", "y", "yaw"), starts[0], strict=True):
            node.set_param(f"~{name}", value)
        self.simulator = Simulator(node, world=self.world, model=BURGER)
        self.names = [""]
        for i, start in enumerate(starts[1:], 1):
            self.names.append(f"robot_{i}")
            self.simulator.spawn(self.names[-1], pose=start)
        listener = graph.node("listener")
        self.heard: dict[str, Heard] = {name: _listen(listener, name) for name in self.names}
        listener.subscriber("/tf", message_class("tf2_msgs/TFMessage"), self._hear_transforms)
        self._driver = graph.node("driver")
        self._told = 0
        publishers = [self._commander(name) for name in self.names]
        message = message_class("geometry_msgs/Twist")()
        message.linear.x, message.angular.z = sim_room.SPEED, sim_room.TURN_RATE

        def drive(_: Any) -> None:
            for publisher in publishers:
                publisher.publish(message)
            self._told += 1

        self._driver.timer(1 / COMMAND_RATE, drive)

    def _commander(self, name: str) -> Any:
        topic = f"{name}/cmd_vel" if name else "cmd_vel"
        return self._driver.publisher(topic, message_class("geometry_msgs/Twist"), queue_size=None)

    def _hear_transforms(self, message: Any) -> None:
        heard = self.heard
        for prefix, row in transforms(message):
            heard[prefix]["tf"].append(row)

    def go(self, seconds: float) -> float:
        """Let so much time pass; return the processor's time that it took [s]."""
        begin = time.process_time()
        self.graph.run(seconds)
        return time.process_time() - begin

    def forget(self) -> None:
        """Let go what was heard."""
        self._told = 0
        for heard in self.heard.values():
            for rows in heard.values():
                rows.clear()

    def check(self, seconds: float) -> None:
        """Raise `RosminiError` unless what was heard since `forget`, `seconds` ago, is right."""
        way = self._told * sim_room.SPEED / COMMAND_RATE
        check_run(self.heard, self.simulator.model, seconds, way)


def _listen(node: Any, name: str) -> Heard:
    """Read what one robot tells, but for the transforms, which it shares with the others."""
    heard: Heard = {topic: [] for topic in READERS}
    for topic, (kind, read) in READERS.items():
        if read is not None:
            full = f"{name}/{topic}" if name else topic
            node.subscriber(full, message_class(kind), _reader(read, heard[topic].append))
    return heard


def _reader(read: Callable[[Any], Row], keep: Callable[[Row], None]) -> Callable[[Any], None]:
    def hear(message: Any) -> None:
        keep(read(message))

    return hear


def real_time_factor(seconds: float, count: int = 1) -> float:
    """Return how many seconds are simulated in a second of processor time.

    One node drives; one holds a subscriber on each topic of each robot, and reads every message. After each `PIECE` the
    clock stops, and what was read is checked.
    """
    spent = 0.0
    with Graph() as graph:
        run = Run(graph, count)
        run.go(PIECE)
        pieces = max(round(seconds / PIECE), 1)
        for _ in range(pieces):
            run.forget()
            spent += run.go(PIECE)
            run.check(PIECE)
    return pieces * PIECE / spent
