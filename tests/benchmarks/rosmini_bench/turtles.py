"""What is measured of turtles: how many times faster than a clock they drive and draw, and what Logo makes of them."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

from rosmini import rosrun
from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.logo import Logo
from rosmini.sim.verbs.logo import source

from . import Measure

TURTLES = (1, 10, 100)


def speed(count: int, seconds: float) -> float:
    """Return seconds of the graph a second of the processor: each turtle gets two commands a second, and circles."""
    graph = Graph()
    sim = rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
    for number in range(1, count):
        sim.spawn(2.0 + number % 7, 2.0 + number % 5, 0.1 * number)
    twist, pose = message_class("geometry_msgs/Twist"), message_class("turtlesim/Pose")
    driver, ear = graph.node("driver"), graph.node("ear")
    heard = 0

    def hear(_: Any) -> None:
        nonlocal heard
        heard += 1

    for name in sim.turtles:
        ear.subscriber(f"{name}/pose", pose, hear, numpy=False)
    commands = [driver.publisher(f"{name}/cmd_vel", twist, queue_size=1) for name in sim.turtles]
    command = twist()
    command.linear.x, command.angular.z = 1.0, 1.0

    def drive(_: Any) -> None:
        for publisher in commands:
            publisher.publish(command)

    driver.timer(0.5, drive)
    graph.run(1.0)
    heard = 0
    begin = time.process_time()
    graph.run(seconds)
    took = time.process_time() - begin
    drawn = sim.frame.paper.count
    graph.shutdown()
    if heard < count * round(62.5 * seconds) - count or drawn < heard:
        msg = f"{heard} poses of {count} turtles came in {seconds} s, and {drawn} strokes: there is no figure"
        raise RosminiError(msg)
    return seconds / max(took, 1e-6)


def programs(count: int, *, in_turtlesim: bool) -> float:
    """Return how many times a second of the processor Logo draws Koch's snowflake: 768 lines, 18,000 instructions."""
    graph = Graph(strict=False)
    logo = Logo()
    if in_turtlesim:
        rosrun("turtlesim", "turtlesim_node", graph=graph).instance()
        graph.run(0.1)
        logo = Logo.on(graph.node("logo"))
    program = source("koch")
    begin = time.process_time()
    for _ in range(count):
        logo.run(program)
    took = time.process_time() - begin
    graph.shutdown()
    if len(logo.drawing.lines) != 768:
        msg = f"the snowflake has {len(logo.drawing.lines)} lines: there is no figure"
        raise RosminiError(msg)
    return count / max(took, 1e-6)


def measures(scale: float) -> Iterator[Measure]:
    """Yield what is measured."""
    for count in TURTLES:
        seconds = max(round(200.0 * scale / count), 1.0)
        what = "1 turtle" if count == 1 else f"{count} turtles"
        yield Measure(
            f"turtlesim: {what} at 62.5 Hz, all poses heard",
            "x real time",
            lambda count=count, seconds=seconds: speed(count, seconds),  # type: ignore[misc]
        )
    for where, in_turtlesim in (("on paper", False), ("in turtlesim", True)):
        yield Measure(
            f"Logo: Koch's snowflake of 768 lines, {where}",
            "programs/s",
            lambda in_turtlesim=in_turtlesim: programs(max(round(20 * scale), 1), in_turtlesim=in_turtlesim),  # type: ignore[misc]
        )
