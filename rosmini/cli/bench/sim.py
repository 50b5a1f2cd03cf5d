"""What is measured of the simulator: how much faster than real time it is, beside ir-sim, and how fast rays are cast."""

from __future__ import annotations

import importlib.util
import math
import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
from rosmini.geometry.raycast import raycast
from rosmini.graph import Graph
from rosmini.msgs import message_class
from rosmini.sim.models import BURGER
from rosmini.sim.simulator import Simulator
from rosmini.sim.world import World

from . import Measure, sim_room
from .sim_checks import READERS, Heard, Row, check_run

if TYPE_CHECKING:
    from .sim_peer import IrSim

COMMAND_RATE = 10
"""So often the robot is told what to do [Hz]."""

PIECE = 2.0
"""So much is simulated at a time [s]; the first piece is not counted."""


def real_time_factor(seconds: float) -> float:
    """Return how many seconds are simulated in a second of processor time.

    One node drives; one holds a subscriber on each topic of the robot, and reads every message. After each `PIECE` the clock stops, and
    what was read is checked.
    """
    world = sim_room.room()
    spent = 0.0
    with Graph() as graph:
        simulator = Simulator(graph.node("simulator"), world=world, model=BURGER)
        heard, way = _listen(graph), _drive(graph)
        graph.run(PIECE)
        pieces = max(round(seconds / PIECE), 1)
        for _ in range(pieces):
            for messages in heard.values():
                messages.clear()
            way.clear()
            begin = time.process_time()
            graph.run(PIECE)
            spent += time.process_time() - begin
            check_run(heard, world, simulator.model, PIECE, sum(way))
    return pieces * PIECE / spent


def _listen(graph: Graph) -> Heard:
    listener = graph.node("listener")
    heard: Heard = {topic: [] for topic in READERS}
    for topic, (kind, read) in READERS.items():
        listener.subscriber(topic, message_class(kind), partial(_hear, read, heard[topic].append))
    return heard


def _hear(read: Callable[[Any], Row], keep: Callable[[Row], None], message: Any) -> None:
    keep(read(message))


def _drive(graph: Graph) -> list[float]:
    """Start to drive; return how far the robot is told to go, command by command [m]."""
    driver = graph.node("driver")
    twist = message_class("geometry_msgs/Twist")
    publisher = driver.publisher("cmd_vel", twist, queue_size=None)
    begin = graph.now()
    way: list[float] = []

    def drive(_: Any) -> None:
        message = twist()
        message.linear.x, message.angular.z = sim_room.command((graph.now() - begin).to_sec())
        publisher.publish(message)
        way.append(message.linear.x / COMMAND_RATE)

    driver.timer(1 / COMMAND_RATE, drive)
    return way


Cast = Callable[[World, float, float], NDArray[np.float64]]


def scans(cast: Cast, count: int) -> float:
    """Return the scans a second of 360 rays up to 3.5 m among 100 segments and 10 discs; some are compared with a loop over all pairs."""
    world = sim_room.crowded_room()
    x, y, _ = sim_room.START
    for place in (x - 0.5, x, x + 0.5):
        _check_scan(cast(world, place, y), world, place, y)
    begin = time.process_time()
    for i in range(count):
        cast(world, x + 0.01 * (i % 50), y)
    return count / (time.process_time() - begin)


def rosmini_scan(backend: str) -> Cast:
    """Rays of `rosmini.geometry.raycast`."""
    lidar = BURGER.laser

    def cast(world: World, x: float, y: float) -> NDArray[np.float64]:
        step = 2 * math.pi / lidar.beams
        return raycast(
            world.segments, world.discs, x, y, 0.0, step, lidar.beams, lidar.range_max, backend=backend
        )

    return cast


def pymunk_scan() -> Cast:
    """Rays of pymunk, which has no laser but can tell the first thing on a line."""
    import pymunk

    lidar = BURGER.laser
    world = sim_room.crowded_room()
    space = pymunk.Space()
    walls = [
        pymunk.Segment(space.static_body, (x1, y1), (x2, y2), 0) for x1, y1, x2, y2 in world.segments.tolist()
    ]
    pillars = [pymunk.Circle(space.static_body, radius, (x, y)) for x, y, radius in world.discs.tolist()]
    space.add(*walls, *pillars)
    everything = pymunk.ShapeFilter()
    angles = 2 * math.pi / lidar.beams * np.arange(lidar.beams)
    ends = (lidar.range_max * np.column_stack([np.cos(angles), np.sin(angles)])).tolist()

    def cast(_: World, x: float, y: float) -> NDArray[np.float64]:
        ranges = np.full(lidar.beams, np.inf)
        for i, (dx, dy) in enumerate(ends):
            hit = space.segment_query_first((x, y), (x + dx, y + dy), 0, everything)
            if hit is not None:
                ranges[i] = hit.alpha * lidar.range_max
        return ranges

    return cast


def _check_scan(found: NDArray[np.float64], world: World, x: float, y: float) -> None:
    """Raise unless the ranges are those of a loop over all pairs, but for rays that just pass a corner."""
    lidar = BURGER.laser
    exact = np.array([_first_hit(world, x, y, 2 * math.pi * i / lidar.beams) for i in range(lidar.beams)])
    exact[exact > lidar.range_max] = np.inf
    wrong = ~np.isclose(found, exact, rtol=0, atol=1e-9)
    if wrong.sum() > 2 or not np.isfinite(found).any():
        msg = f"{wrong.sum()} of {lidar.beams} ranges are wrong, so there is no figure"
        raise RosminiError(msg)


def _first_hit(world: World, x: float, y: float, angle: float) -> float:
    c, s = math.cos(angle), math.sin(angle)
    nearest = math.inf
    for x1, y1, x2, y2 in (world.segments - (x, y, x, y)).tolist():
        cross = c * (y2 - y1) - s * (x2 - x1)
        along = (x1 * (y2 - y1) - y1 * (x2 - x1)) / cross if cross else -1.0
        part = (x1 * s - y1 * c) / cross if cross else -1.0
        if along >= 0 and 0 <= part <= 1:
            nearest = min(nearest, along)
    for px, py, radius in (world.discs - (x, y, 0)).tolist():
        ahead = c * px + s * py
        chord = radius * radius - (c * py - s * px) ** 2
        if chord >= 0 and ahead > 0:
            nearest = min(nearest, ahead - math.sqrt(chord))
    return nearest


def measures(irsim: IrSim | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    seconds = max(60 * scale, PIECE)
    fast, slow = max(int(10_000 * scale), 20), max(int(1_000 * scale), 10)
    yield Measure(
        "one TurtleBot3, every topic heard and checked",
        "simulated s/s",
        lambda: real_time_factor(seconds),
        None if irsim is None else lambda: irsim.real_time_factor(seconds),
        "ir-sim" if irsim is None else irsim.name,
    )
    pymunk_rays = pymunk_scan()
    for backend, count in (("numba", fast), ("numpy", slow)):
        if backend == "numpy" or importlib.util.find_spec("numba"):
            yield Measure(
                f"360 rays, 100 segments and 10 discs, {backend}",
                "scans/s",
                partial(scans, rosmini_scan(backend), count),
                partial(scans, pymunk_rays, slow),
                "pymunk",
            )
