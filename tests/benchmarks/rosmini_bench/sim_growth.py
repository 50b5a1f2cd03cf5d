"""How the cost of the simulator grows with robots, beams and walls, memory for a robot, and leaks in an hour."""

from __future__ import annotations

import gc
import math
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial

import numpy as np

from rosmini.core.errors import RosminiError
from rosmini.core.graph import Graph
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import BURGER

from . import Measure, sim_room
from .sim_engine import make_engine
from .sim_run import PIECE, Run

HOUR = 3600.0
WARM_UP = 20.0
"""After so much time [s] all is there that a run needs, and nothing should come on top."""

LEFT_BEHIND = 2_000
"""So many blocks of memory more after a run are taken for caches, and not for a leak."""

ROBOTS = (1, 3, 10, 30, 100)
BEAMS = (90, 360, 1_440, 5_760)
WALLS = (100, 1_000, 10_000, 100_000)


def exponent(sizes: Sequence[float], costs: Sequence[float]) -> float:
    """With which power of the size the cost grows: the slope of a line through the logarithms, by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(costs), 1)[0])


def step_cost(count: int, seconds: float) -> float:
    """Return the microseconds in which the engine lets a robot of so many go on by 10 ms."""
    engine, names = make_engine(count)
    for name in names:
        engine.command(name, sim_room.SPEED, sim_room.TURN_RATE)
    engine.advance(0.5)
    steps = max(round(seconds * 100 / count), 20)
    begin = time.process_time()
    for number in range(1, steps + 1):
        engine.advance(0.5 + number / 100)
    return (time.process_time() - begin) / steps / count * 1e6


def scan_cost(beams: int, walls: int, times: int) -> float:
    """Return the microseconds of a scan of so many beams, up to 3.5 m, among so many wall segments.

    Always as many to a square metre.
    """
    rng = np.random.default_rng(walls)
    side = math.sqrt(walls)
    middles, turns = rng.uniform(-side / 2, side / 2, (walls, 2)), rng.uniform(0, math.pi, walls)
    half = 0.25 * np.column_stack([np.cos(turns), np.sin(turns)])
    segments, discs = np.hstack([middles - half, middles + half]), np.empty((0, 3))
    step, reach = 2 * math.pi / beams, BURGER.laser.range_max
    seen = raycast(segments, discs, 0.0, 0.0, 0.0, step, beams, reach)
    if not np.isfinite(seen).any():
        raise RosminiError("the laser saw nothing, so there is no figure")
    begin = time.process_time()
    for _ in range(times):
        raycast(segments, discs, 0.0, 0.0, 0.0, step, beams, reach)
    return (time.process_time() - begin) / times * 1e6


def memory_per_robot(more: int = 10) -> float:
    """Return the kilobytes that each robot beyond the first takes, with its six topics and what listens to them."""
    sizes = []
    for count in (1, 1 + more):  # the first makes the caches that all share
        tracemalloc.start()
        try:
            with Graph() as graph:
                run = Run(graph, count)
                run.go(1.0)
                run.forget()
                gc.collect()
                sizes.append(tracemalloc.get_traced_memory()[0])
        finally:
            tracemalloc.stop()
    return (sizes[1] - sizes[0]) / more / 1000


def hour(seconds: float, count: int = 1) -> float:
    """Simulate so long, and return how many more blocks of memory are in use then than after the first seconds.

    Raises `RosminiError` if there are more than a few, or if any queue has become longer.
    """
    with Graph() as graph:
        run = Run(graph, count)
        run.go(WARM_UP)
        run.forget()
        blocks, waiting = _blocks(), _waiting(graph)
        for _ in range(round(seconds / PIECE)):
            run.go(PIECE)
            run.forget()
        more, longer = _blocks() - blocks, _waiting(graph) - waiting
    if more > LEFT_BEHIND or longer > 0:
        msg = f"{seconds:.0f} s of simulated time left {more} blocks of memory and {longer} things more in queues"
        raise RosminiError(msg)
    return float(more)


def _blocks() -> int:
    gc.collect()
    return sys.getallocatedblocks()


def _waiting(graph: Graph) -> int:
    """How much waits: events, and messages that nobody took yet."""
    return graph.scheduler.pending() + sum(
        connection.waiting
        for node in graph.nodes.values()
        for subscription in node.subscriptions.values()
        for connection in subscription.connections.values()
    )


def measures(scale: float) -> Iterator[Measure]:
    """Yield everything that is measured."""
    seconds, times = max(20 * scale, 0.2), max(int(200 * scale), 2)

    def table(what: str, unit: str, sizes: Sequence[int], cost: Callable[[int], float]) -> Iterator[Measure]:
        kept = cache(cost)
        for size in sizes:
            yield Measure(what.format(f"{size:,}"), unit, partial(kept, size), more_is_better=False, once=True)
        name = f"the same, exponent of n ({what.format('n')})"
        yield Measure(
            name, "1", lambda: exponent(sizes, [kept(size) for size in sizes]), more_is_better=False, once=True
        )

    yield from table("engine, each of {} robots", "us/step", ROBOTS, lambda count: step_cost(count, seconds))
    yield from table("scan, {} beams, 100 walls", "us", BEAMS, lambda beams: scan_cost(beams, 100, times))
    yield from table("scan, 360 beams, {} walls", "us", WALLS, lambda walls: scan_cost(360, walls, times))
    yield Measure(
        "memory of a robot with all its topics heard", "kB", memory_per_robot, more_is_better=False, once=True
    )
    length = max(HOUR * scale, PIECE)
    yield Measure(
        f"memory after {length:,.0f} s of simulated time",
        "blocks more",
        lambda: hour(length),
        more_is_better=False,
        once=True,
    )
