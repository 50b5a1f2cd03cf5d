"""How fast amcl is, and how it follows a drive, without a graph; `nav_located` makes studies of it.

Parameters are those of `turtlebot3_navigation`'s amcl.launch.
"""

from __future__ import annotations

import math
import time
import tracemalloc
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.navigation.amcl.field import LikelihoodField
from rosmini.navigation.amcl.filter import ParticleFilter
from rosmini.navigation.amcl.laser import LaserModel, Scan
from rosmini.navigation.amcl.localizer import Localizer
from rosmini.navigation.amcl.motion import sample_motion_model
from rosmini.navigation.amcl.parameters import AmclParameters
from rosmini.ros.launch import plan_of

from . import Measure
from .nav_drives import Drive, drive
from .nav_trial import place

Floats = NDArray[np.float64]

LOST: dict[str, Any] = {
    "recovery_alpha_slow": 0.001,
    "recovery_alpha_fast": 0.1,
    "recovery_candidates": 10,
    "max_particles": 10_000,
    "odom_model_type": "diff-corrected",
    "odom_alpha1": 0.1,
    "odom_alpha2": 0.1,
    "odom_alpha3": 0.1,
    "odom_alpha4": 0.1,
    "laser_model_type": "likelihood_field_prob",
    "laser_z_hit": 0.95,
    "laser_z_rand": 0.05,
    "laser_sigma_hit": 0.8,
    "update_min_d": 0.06,
    "update_min_a": 0.06,
    "resample_interval": 8,
}
"""What a robot takes that is to find itself again: room for many particles of which some are random, and see
`nav_located` for the others."""
FOUND, HELD, WITHIN = 0.3, 30.0, 120.0
"""It has found itself if within so many seconds of driving it begins to be closer than this [m] for so long [s]."""
TURNING = 0.3
"""A robot that turns faster [rad/s] is turning."""
INSIDE = 5.991
"""The 95 % quantile of the chi-square distribution of two dimensions."""
CARRIED = 40.0
"""After so many seconds the robot is kidnapped."""
SPREAD = np.diag([0.1**2, 0.1**2, 0.1**2])
"""Of the particles at the start of a drive that is tracked."""


@cache
def ours() -> AmclParameters:
    """The parameters of our launch file."""
    values = plan_of("turtlebot3_navigation", "amcl.launch").parameters
    names = {one.name for one in fields(AmclParameters)}
    found = {name.rpartition("/")[2]: value for name, value in values.items()}
    return replace(AmclParameters(), **{name: value for name, value in found.items() if name in names})


@dataclass(frozen=True)
class Track:
    """How a filter did over one drive, at each scan."""

    times: Floats
    off: Floats
    """Distance from the truth [m]."""
    turned_off: Floats
    """Difference of the headings [rad]."""
    turning: NDArray[np.bool_]
    inside: tuple[bool, ...]
    """For each estimate whether the truth was in the 95 % ellipse of x and y."""
    particles: Floats
    cpu: float
    """Seconds of the processor an update."""

    def found(self, after: float = 0.0) -> float:
        """After how many seconds it knows where the robot is, for good enough and long enough; or inf."""
        times = self.times - self.times[0] - after
        good = self.off < FOUND
        start = math.inf
        for now, right in zip(times.tolist(), good.tolist(), strict=True):
            if now < 0 or not right:
                start = math.inf
            elif math.isinf(start):
                start = now
            if start <= WITHIN and now - start >= HELD:
                return start
        return math.inf


@cache
def _grid(world: str) -> Any:
    return place(world)[0]


def scan_of(one: Drive, index: int, p: AmclParameters) -> Scan:
    """A scan as the node hands it on."""
    top = one.range_max if p.laser_max_range <= 0 else min(one.range_max, p.laser_max_range)
    ranges = np.where(one.ranges[index] <= 0.12, top, one.ranges[index])
    return Scan(ranges, one.bearings, top, one.laser)


def follow(one: Drive, p: AmclParameters, seed: int, *, lost: bool = False) -> Track:
    """Run the filter over a drive, from near the true pose or from everywhere."""
    localizer = Localizer(p, np.random.default_rng([seed, 18]))
    localizer.set_map(_grid(one.world))
    random = np.random.default_rng([seed, 19])
    start = one.truth[0] + random.normal(0.0, 0.1, 3)
    if lost:
        localizer.initialize_globally()
    else:
        localizer.initialize((float(start[0]), float(start[1]), float(start[2])), SPREAD)
    correction: Pose | None = None
    off, turned, inside, particles, updates = [], [], [], [], 0
    cpu = time.process_time()
    for index, odometry in enumerate(map(_pose, one.odometry)):
        news = localizer.update("scan", scan_of(one, index, p), odometry)
        updates += news is not None
        truth = one.truth[index]
        if news:
            estimate = localizer.estimate()
            correction = compose(estimate.pose, inverse(odometry))
            away = truth[:2] - localizer.filter.mean().mean[:2]
            inside.append(bool(away @ np.linalg.pinv(estimate.covariance[:2, :2]) @ away <= INSIDE))
        here = compose(correction or (0.0, 0.0, 0.0), odometry)
        off.append(math.dist(here[:2], truth[:2]))
        turned.append(abs(math.remainder(here[2] - truth[2], math.tau)))
        particles.append(len(localizer.filter.particles))
    cpu = time.process_time() - cpu
    rate = np.abs(np.gradient(one.truth[:, 2], one.times)) > TURNING
    return Track(
        one.times, np.array(off), np.array(turned), rate, tuple(inside), np.array(particles), cpu / max(updates, 1)
    )


def _pose(row: Floats) -> Pose:
    return float(row[0]), float(row[1]), float(row[2])


@cache
def drives(world: str, seed: int, seconds: float) -> Drive:
    """A drive, made once."""
    return drive(world, seed, seconds)


# -- speed ---------------------------------------------------------------------------------------------------------


def update_cost(count: int, beams: int, kind: str = "likelihood_field", times: int = 15) -> float:
    """Milliseconds of the processor for odometry, weighing and resampling of so many particles."""
    grid = _grid("house")
    field = LikelihoodField(grid.occupied, grid.resolution, grid.origin[:2], 2.0, grid.free)
    particles = ParticleFilter(count, count, random=np.random.default_rng(1))
    pose = (-3.0, 1.0, 0.0)
    particles.initialize(pose, SPREAD)
    bearings = np.arange(beams) * math.tau / beams
    scan = Scan(field.ranges(np.array([pose]), bearings, 3.5)[0], bearings, 3.5)
    model = LaserModel(kind, max_beams=beams)
    alphas = (0.1,) * 5
    found = []
    for _ in range(times + 1):
        start = time.process_time()
        noise = particles.random.standard_normal((count, 3))
        particles.particles = sample_motion_model(
            particles.particles, pose, compose(pose, (0.01, 0.0, 0.01)), alphas, noise
        )
        particles.update_weights(model.log_likelihoods(field, particles.particles, scan))
        particles.resample(lambda wanted: np.zeros((wanted, 3)))
        found.append(time.process_time() - start)
    return 1e3 * float(np.median(found[1:]))


def map_memory(side: int) -> float:
    """Megabytes that a localizer holds with a map of so many cells a side."""
    from rosmini.core.maps.grid_map import GridMap

    cells = np.zeros((side, side), dtype=np.int8)
    cells[::100] = 100
    grid = GridMap(cells, 0.05, (0.0, 0.0, 0.0))
    tracemalloc.start()
    localizer = Localizer(ours(), np.random.default_rng(1))
    localizer.set_map(grid)
    assert localizer.field is not None
    localizer.field.densities(localizer.model.mixture, 3.5, "cube")
    held, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return held / 1e6


def map_cost(side: int) -> float:
    """Milliseconds of the processor to take a map of so many cells a side."""
    cells = np.zeros((side, side), dtype=bool)
    cells[::100] = True
    start = time.process_time()
    LikelihoodField(cells, 0.05, (0.0, 0.0))
    return 1e3 * (time.process_time() - start)


def measures(scale: float) -> Iterator[Measure]:
    """What `rosmini bench nav` measures of amcl."""
    times = 15 if scale >= 1 else 2
    for count, beams in ((500, 60), (2000, 60), (2000, 360), (10_000, 60)) if scale >= 1 else ((200, 60),):
        name = f"amcl, odometry, {beams} beams and resampling of {count} particles"
        yield Measure(name, "ms of CPU", partial(update_cost, count, beams, times=times), more_is_better=False)
    count = 2000 if scale >= 1 else 200
    name = f"amcl, the same of {count} particles, 60 beams, beam model"
    yield Measure(name, "ms of CPU", partial(update_cost, count, 60, "beam", times), more_is_better=False)
    for side in (400, 4000) if scale >= 1 else (100,):
        name = f"amcl, a map of {side} x {side} cells"
        yield Measure(name, "ms of CPU", partial(map_cost, side), more_is_better=False)
        yield Measure(name, "MB", partial(map_memory, side), more_is_better=False, once=True)
