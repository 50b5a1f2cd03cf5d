"""The cost of the engine without a graph: only poses and scans, as the other simulators are measured."""

from __future__ import annotations

import math
import time
import zlib
from itertools import pairwise

import numpy as np

from rosmini.core.geometry.poses import Pose
from rosmini.sim.engine import Engine
from rosmini.sim.models import BURGER
from rosmini.sim.world import World

from . import sim_room
from .sim_checks import expect

RATE = 100
"""So often it is asked where the robots are [Hz]."""

COMMANDS = 10
"""So often they are told what to do [Hz]."""


def rng(name: str) -> np.random.Generator:
    """The generator for what is called so."""
    return np.random.default_rng(zlib.crc32(name.encode()))


def make_engine(count: int, world: World | None = None, starts: list[Pose] | None = None) -> tuple[Engine, list[str]]:
    """An engine with so many TurtleBot3 in it, and their names."""
    engine = Engine(world or sim_room.room(), rng)
    names = [f"robot_{i}" for i in range(count)]
    for name, start in zip(names, starts or sim_room.starts(count), strict=True):
        engine.add(name, BURGER, start)
    return engine, names


def engine_factor(seconds: float, count: int) -> float:
    """Return simulated seconds a second of processor time: 100 poses and 5 scans of each robot a second."""
    engine, names = make_engine(count)
    lidar, noise = BURGER.laser, rng("lidar")
    tracks: dict[str, list[Pose]] = {name: [] for name in names}
    begin = 0.0
    for number in range(-RATE, max(round(seconds * RATE), RATE) + 1):  # in the first second the clock stands
        if number == 0:
            begin = time.process_time()
        if number % (RATE // COMMANDS) == 0:
            for name in names:
                engine.command(name, sim_room.SPEED, sim_room.TURN_RATE, 0.5)
        engine.advance((number + RATE) / RATE)
        for name in names:
            tracks[name].append(engine.robots[name].pose)
        if number % round(RATE / lidar.rate) == 0:
            for name in names:
                engine.scan(name, noise.standard_normal(lidar.beams) * lidar.noise)
    spent = time.process_time() - begin
    for track in tracks.values():
        driven = track[RATE:]
        length = sum(math.dist(one[:2], other[:2]) for one, other in pairwise(driven))
        expected = (len(driven) - 1) / RATE * sim_room.SPEED
        expect(abs(length / expected - 1) < 0.1, f"a robot went {length:.3f} m, and was told to go {expected:.3f} m")
    return (number / RATE) / spent


def crowd_factor(seconds: float, count: int) -> float:
    """Return the same for `robots` that are in one another's way and push: their circles have half the space.

    Poses are asked for a hundred times a second; there are no scans. Raises `RosminiError` if nobody touches anything,
    or somebody leaves the room.
    """
    engine, names = make_engine(count)
    begin, touching, number = 0.0, 0, 0
    for number in range(max(round(seconds * RATE), RATE) + 2 * RATE):  # in the first two seconds they get at each other
        if number == 2 * RATE:
            begin = time.process_time()
        if number % (RATE // COMMANDS) == 0:
            for name in names:
                engine.command(name, 2 * sim_room.SPEED, sim_room.TURN_RATE, 0.5)
        engine.advance(number / RATE)
        if number >= 2 * RATE:
            touching += sum(robot.touching for robot in engine.robots.values())
    spent = time.process_time() - begin
    inside = sim_room.SIZE / 2
    expect(touching > 0, f"none of {count} robots touched anything")
    for robot in engine.robots.values():
        x, y, _ = robot.pose
        expect(abs(x) < inside and abs(y) < inside, f"{robot.name} left the room, to ({x:.2f}, {y:.2f})")
    return (number + 1 - 2 * RATE) / RATE / spent
