"""How good gmapping's maps and paths are, and what they cost; `nav_located` makes studies of it."""

from __future__ import annotations

import itertools
import math
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.navigation.gmapping.extent import known
from rosmini.navigation.gmapping.maps import SharedMaps
from rosmini.navigation.gmapping.slam import GridSlam, Settings

from . import Measure
from .nav_drives import drive
from .nav_trial import place

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

DATA = Path(os.environ.get("ROSMINI_SHARED_DATA", Path(__file__).resolve().parents[4] / "shared" / "data"))
APART, NEAR = 60, 1.0
"""A revisit: two scans more than so many apart, taken less than so far [m] from each other."""
OURS: dict[str, Any] = {"linear_update": 0.2, "angular_update": 0.25, "max_urange": 3.0}
"""Parameters of our choice for a TurtleBot3."""
OCCUPIED = 0.25


@dataclass(frozen=True)
class Walls:
    """What a map should show, as cells (h, w) of a grid."""

    surface: Bools
    """Every side of something at the laser's height."""
    visible: Bools
    """Of these what the robot can have seen."""
    resolution: float
    origin: tuple[float, float]


@dataclass(frozen=True)
class Log:
    """What a mapper gets, and what is known of the truth."""

    name: str
    times: Floats
    odometry: Floats
    truth: Floats
    ranges: Floats
    bearings: Floats
    range_max: float
    laser: Pose
    walls: Walls | None = None


@dataclass(frozen=True)
class Run:
    """What a mapper made of a log."""

    slam: GridSlam
    poses: Floats
    """(n, 3) for each scan of the log: the best path, with odometry between the scans that were taken in."""
    taken: NDArray[np.int64]
    cpu: float
    """Seconds of the processor a scan that was taken in, the first one not counted."""


def house() -> Log | None:
    """The burger's drive through the house, if shared data are there."""
    path = DATA / "log_house.npz"
    if not path.is_file():
        return None
    log = np.load(path)
    ranges = log["ranges_mm"] / 1000.0
    ranges[log["ranges_mm"] == 0] = math.inf
    ranges[log["ranges_mm"] == 65535] = 0.0
    shape = tuple(log["grid_shape"])
    cells = [np.unpackbits(log[name])[: math.prod(shape)].reshape(shape) > 0 for name in ("surface", "visible")]
    walls = Walls(cells[0], cells[1], float(log["grid_res"]), tuple(log["grid_origin"].tolist()))
    bearings = float(log["angle_min"]) + float(log["angle_increment"]) * np.arange(ranges.shape[1])
    poses = log["odom"].astype(float), log["truth"].astype(float)
    laser = tuple(log["laser_in_base"].tolist())
    return Log("log_house", log["t"], *poses, ranges, bearings, float(log["range_max"]), laser, walls)


def csail() -> Log | None:
    """A real robot on a floor of MIT; its truth is what the original gmapping found."""
    path = DATA / "csail.npz"
    if not path.is_file():
        return None
    log = np.load(path)
    bearings = np.linspace(-math.pi / 2, math.pi / 2, log["ranges"].shape[1])
    poses = log["odom"], log["corrected"]
    return Log("csail", log["t"], *poses, log["ranges"].astype(float), bearings, 81.91, (0.0, 0.0, 0.0))


def recorded(world: str, seed: int, seconds: float) -> Log:
    """A fresh drive through a world of ours, with the people who walk there."""
    found = drive(world, seed, seconds)
    grid = place(world)[0]
    walls = Walls(grid.occupied, grid.occupied, grid.resolution, (grid.origin[0], grid.origin[1]))
    poses = found.times, found.odometry, found.truth
    return Log(world, *poses, found.ranges, found.bearings, found.range_max, found.laser, walls)


def run(log: Log, seed: int, **changes: Any) -> Run:
    """Map a log."""
    reach = log.range_max - 0.01
    start: Pose = tuple(log.odometry[0].tolist())
    settings = replace(Settings(max_range=reach, max_urange=reach), **changes)
    slam = GridSlam(settings, laser=log.laser, start=start, random=np.random.default_rng(seed))
    taken, cpu = [], []
    for index, odometry in enumerate(log.odometry.tolist()):
        begin = time.process_time()
        report = slam.process(log.ranges[index], log.bearings, tuple(odometry), float(log.times[index]))
        if report is not None:
            cpu.append(time.process_time() - begin)
            taken.append(index)
    nodes = np.array([node.pose for node in slam.path()])
    last = np.searchsorted(taken, np.arange(len(log.times)), side="right") - 1
    since = compose(inverse(log.odometry[taken][last]), log.odometry)
    return Run(slam, compose(nodes[last], since), np.array(taken), float(np.mean(cpu[1:])))


# -- how good ------------------------------------------------------------------------------------------------------


def off_at_start(poses: Floats, truth: Floats) -> float:
    """RMS of the distances [m] between two paths that begin alike."""
    aligned = compose(onto(poses[0], truth[0]), poses)
    return float(np.sqrt(np.mean(np.sum((aligned - truth)[:, :2] ** 2, axis=1))))


def onto(pose: Floats, wanted: Floats) -> Pose:
    """What moves a pose to where it should be."""
    x, y, heading = compose(tuple(wanted.tolist()), inverse(tuple(pose.tolist())))
    return x, y, heading


def relative(poses: Floats, truth: Floats, pairs: tuple[Any, Any]) -> tuple[Floats, Floats]:
    """How wrong the motions between pairs of poses are: distances [m] and angles [rad]."""
    first, second = pairs
    found, real = (compose(inverse(path[first]), path[second]) for path in (poses, truth))
    turned = np.abs((found - real)[:, 2] + math.pi) % math.tau - math.pi
    return np.hypot(*(found - real)[:, :2].T), np.abs(turned)


def revisits(truth: Floats) -> tuple[Any, Any]:
    """Pairs of scans from nearly the same place at different times."""
    x, y = truth[:, 0], truth[:, 1]
    near = np.hypot(x[:, None] - x, y[:, None] - y) < NEAR
    first, second = np.nonzero(np.triu(near, APART + 1))
    return first, second


def map_quality(slam: GridSlam, walls: Walls, moved: Pose, cells: int) -> tuple[float, float]:
    """Precision and recall of the occupied cells within so many cells; `moved` brings the map onto the walls."""
    shares, extent = known(slam, slam.best)
    rows, columns = np.nonzero(shares > OCCUPIED)
    delta = slam.settings.delta
    x, y = (columns + extent.column + 0.5) * delta, (rows + extent.row + 0.5) * delta
    points = compose(moved, np.column_stack([x, y, np.zeros(len(x))]))
    where = np.floor((points[:, :2] - walls.origin) / walls.resolution).astype(int) + cells
    room = np.pad(walls.surface, cells)
    inside = ((where >= 0) & (where < np.array(room.shape[::-1]))).all(axis=1)
    found = np.zeros(room.shape, dtype=bool)
    found[where[inside, 1], where[inside, 0]] = True
    right = _wider(room, cells)[where[inside, 1], where[inside, 0]].sum() / max(len(where), 1)
    seen = np.pad(walls.visible, cells)
    return float(right), float(_wider(found, cells)[seen].mean())


def _wider(mask: Bools, cells: int) -> Bools:
    """All cells within so many of a true one, diagonals counted as one."""
    wide = mask.copy()
    for dy, dx in itertools.product(range(-cells, cells + 1), repeat=2):
        wide |= np.roll(mask, (dy, dx), axis=(0, 1))
    return wide


# -- cost ----------------------------------------------------------------------------------------------------------


def scan_cost(particles: int, beams: int, times: int) -> float:
    """Milliseconds of the processor to match and write a scan, in a square room, 0.1 m farther each time."""
    bearings = np.arange(beams) * math.tau / beams
    slam = GridSlam(Settings(particles=particles, linear_update=0.05), random=np.random.default_rng(1))
    cpu = []
    for step in range(times + 2):
        x = 0.1 * step
        ranges = 3.0 / np.maximum(np.abs(np.cos(bearings)), np.abs(np.sin(bearings))) - x * np.cos(bearings)
        begin = time.process_time()
        slam.process(ranges, bearings, (x, 0.0, 0.0), float(step))
        cpu.append(time.process_time() - begin)
    return 1e3 * float(np.median(cpu[2:]))


def memory(particles: int, side: int) -> float:
    """Megabytes of maps of so many cells a side, all seen: one map that all came from, and a scan for each since."""
    maps = SharedMaps(particles, 0.05)
    maps.cover(0.0, 0.0, side * 0.05, side * 0.05)
    blocks = maps.tables[0].size
    maps._add_patches(blocks)
    maps.tables[:] = np.arange(1, blocks + 1, dtype=np.int32).reshape(maps.tables.shape[1:])
    maps.choose(np.arange(particles))
    middle = side * 0.05 / 2
    poses = np.tile((middle, middle, 0.0), (particles, 1))
    maps.register(poses, np.full(360, 3.5), np.arange(360) * math.tau / 360, 3.5)
    return maps.bytes_used / 1e6


def measures(scale: float) -> Iterator[Measure]:
    """What `rosmini bench nav` measures of gmapping."""
    full = scale >= 1
    for particles, beams in ((30, 360), (60, 360), (100, 360), (30, 180), (30, 720)) if full else ((3, 60),):
        name = f"gmapping, a scan of {beams} beams, {particles} particles"
        yield Measure(name, "ms of CPU", partial(scan_cost, particles, beams, 10 if full else 2), more_is_better=False)
    for particles in (30, 100) if full else (3,):
        side = 4000 if full else 200
        name = f"gmapping, maps of {particles} particles, {side} x {side} cells seen"
        yield Measure(name, "MB", partial(memory, particles, side), more_is_better=False, once=True)
