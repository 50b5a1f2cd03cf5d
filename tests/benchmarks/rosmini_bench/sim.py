"""Measures the simulator: real-time factors beside ir-sim, raycasting, and physical correctness."""

from __future__ import annotations

import importlib.util
import math
import os
import time
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.sim.geometry.raycast import VARIABLE, raycast
from rosmini.sim.models import BURGER
from rosmini.sim.world import World

from . import Measure, sim_growth, sim_physics, sim_room
from .sim_checks import first_hit
from .sim_engine import crowd_factor, engine_factor
from .sim_run import PIECE, real_time_factor

if TYPE_CHECKING:
    from .sim_peer import Peer

Cast = Callable[[World, float, float], NDArray[np.float64]]


def scans(cast: Cast, count: int) -> float:
    """Return the scans a second of 360 rays up to 3.5 m among 100 segments and 10 discs.

    Some are compared with a loop over all pairs.
    """
    world = sim_room.crowded_room()
    x, y, _ = sim_room.START
    for place in (x - 0.5, x, x + 0.5):
        _check_scan(cast(world, place, y), world, place, y)
    begin = time.process_time()
    for i in range(count):
        cast(world, x + 0.01 * (i % 50), y)
    return count / (time.process_time() - begin)


def rosmini_scan(backend: str) -> Cast:
    """Rays of `rosmini.sim.geometry.raycast`."""
    lidar = BURGER.laser

    def cast(world: World, x: float, y: float) -> NDArray[np.float64]:
        step = 2 * math.pi / lidar.beams
        return raycast(world.segments, world.discs, x, y, 0.0, step, lidar.beams, lidar.range_max, backend=backend)

    return cast


def pymunk_scan() -> Cast:
    """Rays of pymunk, which has no laser but can tell the first thing on a line."""
    import pymunk

    lidar = BURGER.laser
    world = sim_room.crowded_room()
    space = pymunk.Space()
    walls = [pymunk.Segment(space.static_body, (x1, y1), (x2, y2), 0) for x1, y1, x2, y2 in world.segments.tolist()]
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
    exact = np.array([first_hit(world, x, y, 2 * math.pi * i / lidar.beams) for i in range(lidar.beams)])
    exact[exact > lidar.range_max] = np.inf
    wrong = ~np.isclose(found, exact, rtol=0, atol=1e-9)
    if wrong.sum() > 2 or not np.isfinite(found).any():
        msg = f"{wrong.sum()} of {lidar.beams} ranges are wrong, so there is no figure"
        raise RosminiError(msg)


ROBOTS = (1, 2, 10, 100)


def measures(irsim: Peer | None, scale: float) -> Iterator[Measure]:
    """Yield everything that is measured; `scale` under 0.01 leaves out the hundred robots that are heard.

    Steady speed is measured, so numba casts the rays from the start where it is installed.
    """
    if importlib.util.find_spec("numba"):
        os.environ.setdefault(VARIABLE, "numba")
    for count in ROBOTS if scale >= 0.01 else ROBOTS[:-1]:
        several = f"{count} TurtleBot3" if count > 1 else "one TurtleBot3"
        yield Measure(
            f"{several}, every topic heard and checked",
            "simulated s/s",
            partial(real_time_factor, max(60 * scale / count, PIECE), count),
            *_beside(irsim, 60 * scale / count**1.5, count, scale),
        )
    for count in ROBOTS:
        several = f"{count} robots" if count > 1 else "one robot"
        yield Measure(
            f"{several}, engine alone, poses at 100 Hz, scans at 5 Hz",
            "simulated s/s",
            partial(engine_factor, max(200 * scale / count, 1.0), count),
        )
    yield Measure(
        "100 robots that push one another, engine alone, poses at 100 Hz",
        "simulated s/s",
        partial(crowd_factor, max(10 * scale, 1.0), 100),
    )
    fast, slow = max(int(10_000 * scale), 20), max(int(1_000 * scale), 10)
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
    yield from sim_growth.measures(scale)
    yield from sim_physics.measures(scale)


def _beside(peer: Peer | None, seconds: float, count: int, scale: float) -> tuple[Callable[[], float] | None, str]:
    """What a peer does beside us, and its name. A hundred robots take ir-sim too long to be only tried out."""
    if peer is None or (count >= 100 and scale < 0.2):
        return None, "" if peer is None else peer.name
    return partial(peer.real_time_factor, max(seconds, 0.3), count), peer.name
