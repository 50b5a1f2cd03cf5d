"""Drives to study localisation with: a robot driven from place to place once, and what it saw as arrays.

A driver who knows where the robot is follows shortest paths at 0.2 m/s and turns on the spot at corners, so that there
is straight driving and turning. A filter can then be run over a drive alone, without a graph.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph import Graph
from rosmini.msgs import message_class
from rosmini.navigation.nav_core.poses import planar_pose
from rosmini.sim.models import BURGER
from rosmini.sim.simulator import Simulator
from rosmini.sim.worlds import world as world_called
from rosmini.sim.worlds.world_map import to_map

from .nav_goals import DISC, Terrain

Floats = NDArray[np.float64]

SPEED, TURN = 0.2, 1.0
"""Of the driver [m/s, rad/s]."""
BEND = 0.4
"""A heading that is farther off [rad] is mended by turning on the spot."""
NEAR = 0.12
"""A corner counts as reached from so far [m]."""
COMMAND_RATE = 10.0
STUCK, BACK = 1.0, 1.0
"""Who has neither come 5 cm farther nor turned by 0.1 rad in so many seconds drives back for so many [s] and goes
somewhere else."""
PERSON = 0.2
"""The radius of somebody who stands beside the robot [m]."""


@dataclass(frozen=True)
class Drive:
    """What a robot saw and did, at the stamps of its scans."""

    world: str
    times: Floats
    """(n,) [s]"""
    odometry: Floats
    """(n, 3)"""
    truth: Floats
    """(n, 3)"""
    ranges: Floats
    """(n, b) [m]; inf where nothing was hit."""
    bearings: Floats
    """(b,) [rad]"""
    range_max: float
    laser: Pose
    """Where the laser is on the robot."""


@cache
def terrain(world: str) -> tuple[Terrain, NDArray[np.intp]]:
    """Where one can drive in a world, and the cells to draw places from; what can be pushed stands in the way, too."""
    known = world_called(world)
    things = [replace(each, mass=None) if each.movable else each for each in known.obstacles]
    found = Terrain(to_map(known.with_just(each for each in things if each.fixed)))
    return found, np.argwhere(found.within(DISC, found.cell(*known.starts[0][:2])))


class _Driver:
    """Drives from one place to the next, and looks at the truth."""

    def __init__(
        self, graph: Graph, world: str, simulator: Simulator, random: np.random.Generator, turn: float, rest: float
    ) -> None:
        self.terrain, self.places = terrain(world)
        self.simulator, self.random, self.turn, self.rest = simulator, random, turn, rest
        self.node = graph.node("driver")
        self.sender = self.node.publisher("cmd_vel", message_class("geometry_msgs/Twist"), queue_size=1)
        self.path: list[tuple[float, float]] = []
        self.since, self.there, self.back_until = 0.0, (math.inf, math.inf, 0.0), 0.0
        self.node.timer(1 / COMMAND_RATE, self.drive)

    def drive(self, _: Any) -> None:
        x, y, yaw = self.simulator.truth()
        now = self.simulator.now
        if now < self.rest:
            return
        turned = abs(math.remainder(yaw - self.there[2], math.tau))
        if math.dist((x, y), self.there[:2]) > 0.05 or turned > 0.1:
            self.since, self.there = now, (x, y, yaw)
        elif now - self.since > STUCK:
            self.path, self.since, self.back_until = [], now, now + BACK
        while self.path and math.dist((x, y), self.path[0]) < NEAR:
            self.path.pop(0)
        if not self.path:
            self.path = self.somewhere((x, y))
        turn = math.remainder(math.atan2(self.path[0][1] - y, self.path[0][0] - x) - yaw, math.tau)
        message = message_class("geometry_msgs/Twist")()
        if now < self.back_until:
            message.linear.x = -SPEED / 2
        else:
            message.linear.x = SPEED if abs(turn) < BEND else 0.0
            message.angular.z = max(-self.turn, min(self.turn, 2.0 * turn))
        self.sender.publish(message)

    def somewhere(self, here: tuple[float, float]) -> list[tuple[float, float]]:
        """The corners of a path to a place at random."""
        start = self.terrain.cell(*here)
        for _ in range(20):
            row, column = (int(v) for v in self.places[self.random.integers(len(self.places))])
            found = self.terrain.shortest(start, (row, column))
            if found is not None and len(found) > 1:
                return found[1:]
        return [here[0:2], (here[0] + float(self.random.uniform(-1, 1)), here[1] + float(self.random.uniform(-1, 1)))]


def drive(world: str, seed: int, seconds: float, *, turn: float = TURN, sweep: bool = True, rest: float = 0.0) -> Drive:
    """Drive a burger around in a world from a start at random; a seed gives the same drive again.

    `turn` is the fastest turn [rad/s]; without `sweep` a scan's beams are measured all at once. The robot stands still
    for `rest` seconds before it drives off.
    """
    random = np.random.default_rng([seed, 36])
    _, places = terrain(world)
    row, column = (int(v) for v in places[random.integers(len(places))])
    x, y = terrain(world)[0].point((row, column))
    scans: list[Any] = []
    odometry: list[tuple[float, ...]] = []
    truth: list[tuple[float, ...]] = []

    def note(kept: list[tuple[float, ...]]) -> Any:
        return lambda message: kept.append((message.header.stamp.to_sec(), *planar_pose(message.pose.pose)))

    with Graph(seed=seed) as graph:
        node = graph.node("simulator")
        for name, value in zip(("x", "y", "yaw"), (x, y, float(random.uniform(-3, 3))), strict=True):
            node.set_param(f"~{name}", value)
        node.set_param("~sweep", sweep)
        simulator = Simulator(node, world=world_called(world), model=BURGER)
        ears = graph.node("ears")
        ears.subscriber("scan", message_class("sensor_msgs/LaserScan"), scans.append)
        odometry_type = message_class("nav_msgs/Odometry")
        ears.subscriber("odom", odometry_type, note(odometry))
        ears.subscriber("base_pose_ground_truth", odometry_type, note(truth))
        _Driver(graph, world, simulator, random, turn, rest)
        graph.run(seconds)
    assert BURGER.lidar is not None
    stamps = np.array([scan.header.stamp.to_sec() for scan in scans])
    known = (stamps >= max(odometry[0][0], truth[0][0])) & (stamps <= min(odometry[-1][0], truth[-1][0]))
    scans = list(itertools.compress(scans, known))
    bearings = scans[0].angle_min + scans[0].angle_increment * np.arange(len(scans[0].ranges))
    return Drive(
        world,
        stamps[known],
        poses_at(stamps[known], np.array(odometry)),
        poses_at(stamps[known], np.array(truth)),
        np.array([scan.ranges for scan in scans], dtype=float),
        bearings,
        float(scans[0].range_max),
        (*BURGER.lidar.mount[:2], BURGER.lidar.yaw),
    )


def poses_at(stamps: Floats, rows: Floats) -> Floats:
    """Poses (n, 3) at some times, between rows of time, x, y and heading."""
    columns = (rows[:, 1], rows[:, 2], np.unwrap(rows[:, 3]))
    return np.column_stack([np.interp(stamps, rows[:, 0], column) for column in columns])


def kidnapped(before: Drive, after: Drive, when: float) -> Drive:
    """Two drives in one world as one: after `when` seconds the robot is carried away; odometry notices nothing."""
    first = before.times - before.times[0] < when
    last = before.odometry[first][-1]
    carried = compose(tuple(last), compose(inverse(tuple(after.odometry[0])), after.odometry))
    return replace(
        before,
        times=np.concatenate([before.times[first], after.times - after.times[0] + before.times[first][-1] + 0.2]),
        odometry=np.concatenate([before.odometry[first], carried]),
        truth=np.concatenate([before.truth[first], after.truth]),
        ranges=np.concatenate([before.ranges[first], after.ranges]),
    )


def accompanied(one: Drive, people: int, seed: int) -> tuple[Drive, float]:
    """A drive with people who walk along with the robot, none of them in the map; and which share of beams they stop.

    Each keeps a distance of 0.8 to 1.3 m and wanders around the robot by 20 degrees in a second.
    """
    random = np.random.default_rng([seed, people])
    ranges, stopped = one.ranges.copy(), 0
    away = random.uniform(0.8, 1.3, people)
    steps = random.normal(0.0, math.radians(20) * math.sqrt(0.2), (len(one.times), people))
    where = random.uniform(-math.pi, math.pi, people) + np.cumsum(steps, axis=0)
    for index, around in enumerate(where):
        heading = one.truth[index, 2]
        for distance, angle in zip(away, around, strict=True):
            off = np.remainder(one.bearings + heading - angle + math.pi, math.tau) - math.pi
            inside = PERSON**2 - (distance * np.sin(off)) ** 2
            hit = (inside > 0) & (np.cos(off) > 0)
            side = distance * np.cos(off) - np.sqrt(np.maximum(inside, 0.0))
            nearer = hit & (side < ranges[index])
            ranges[index, nearer] = side[nearer]
            stopped += int(nearer.sum())
    return replace(one, ranges=ranges), stopped / ranges.size
