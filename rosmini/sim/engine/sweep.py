"""Scans of a laser that takes time for a revolution: each beam starts from the robot's pose at the time of the beam.

Exact poses are computed at `GRID` + 1 times of a revolution, and moving objects are assumed to follow arcs between
them. So the origins of the beams are exact while speeds are constant; while speeds change, the error is at most a T^2 /
(8 GRID^2), for an acceleration a and a revolution in the time T: a Burger that begins to turn with 12.5 rad/s^2, its
maximum, is off by 0.6 milliradians for a moment. Other moving objects are placed, for each `BEAMS_PER_POSE` beams, at
their pose in the middle of them: an error of 2.2 ms of their motion, half a millimetre for a Burger, and 3 mm for a
walker at 1.4 m/s.

Where compilation pays off, one compiled function computes a sweep, `rosmini.sim.engine.sweep_kernel.sweep`; otherwise
numpy does, with the same ranges to the last bit.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import cos_sin
from rosmini.sim.geometry import raycast
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import measured

from . import sweep_kernel
from .cross_sections import CrossSection, at_each_pose, obstacle_section, stack
from .sweep_kernel import BEAMS_PER_POSE
from .trails import PoseOnLeg, between

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.core.geometry.poses import Pose

    from .bodies import Crate
    from .movers import Mover
    from .population import Population
    from .robot import Robot

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GRID = 10
"""Number of equal parts of a revolution; poses are exact at their ends."""

PARTS = tuple(part / GRID for part in range(GRID, -1, -1))
"""Fractions of a revolution that remain at these times."""

NO_NOISE: Floats = np.empty(0)


class Sweeps:
    """The motion of all bodies during the last revolution, computed once for all lasers whose revolutions coincide."""

    def __init__(self, population: Population, scan: Callable[[str, Floats | None, LidarModel], Floats]) -> None:
        self._population = population
        self._scan = scan  # measures all beams at once
        self._moment: tuple[float, int, float] | None = None

    def scan(self, viewer: Robot, lidar: LidarModel, beam_time: float, noise: Floats | None) -> tuple[Floats, Floats]:
        """Return the ranges (beams,) [m], and the robot's pose at each beam (beams, 3).

        The first beam is measured now, each further one `beam_time` [s] earlier.
        """
        count = lidar.beams
        self._update_tracks(beam_time * count)
        seen_from = np.empty((count, 3))
        if viewer.name not in self._numbers:
            seen_from[:] = viewer.pose
        if not self._numbers:
            return self._scan(viewer.name, noise, lidar), seen_from
        reach = lidar.range_max if noise is None else lidar.range_max + 6 * lidar.noise
        if raycast.backend(count) == "numpy":
            return self._with_numpy(viewer, lidar, beam_time, noise, reach, seen_from), seen_from
        own = self._numbers.get(viewer.name, -1)
        mx, my, height = lidar.mount
        ranges = np.empty(count)
        first = lidar.yaw + lidar.angle_min
        sweep_kernel.compiled()(
            own,
            self._population.now,
            beam_time,
            np.array((mx, my, first, lidar.increment, reach, lidar.range_min, lidar.range_max)),
            self._starts,
            self._times,
            self._poses,
            *self._outlines(height),
            self._around,
            *self._stationary_section(viewer, lidar),
            NO_NOISE if noise is None else noise,
            seen_from,
            ranges,
        )
        return ranges, seen_from

    def _with_numpy(
        self, viewer: Robot, lidar: LidarModel, beam_time: float, noise: Floats | None, reach: float, seen_from: Floats
    ) -> Floats:
        """Compute the ranges without numba, and fill in `seen_from` if the viewer moved."""
        count, now = lidar.beams, self._population.now
        beams = np.arange(count, dtype=np.float64)
        own = self._numbers.get(viewer.name, -1)
        if own >= 0:
            seen_from[:] = between(*self._track(own), now - beam_time * beams)
        angles = seen_from[:, 2] + (lidar.yaw + lidar.angle_min) + lidar.increment * beams
        c, s = cos_sin(seen_from[:, 2])
        mx, my, height = lidar.mount
        places = np.column_stack([seen_from[:, 0] + c * mx - s * my, seen_from[:, 1] + s * mx + c * my])
        back = bool(angles[-1] < angles[0])
        middle = places[count - 1 - count // 2 if back else count // 2].copy()
        places -= middle  # all coordinates are relative to it, as in `sweep`
        moved = float(np.hypot(*places.T).max())
        away = np.hypot(*(self._around[:, :2] - middle).T) - self._around[:, 2]
        begins = np.arange(0, count, BEAMS_PER_POSE)
        spans = np.column_stack([begins, np.minimum(begins + BEAMS_PER_POSE, count)])
        middles = now - beam_time * (spans.sum(axis=1) - 1) / 2
        sides, segments, discs = self._outlines(height)
        walls, pillars = self._stationary_section(viewer, lidar)
        cuts = [(walls - (*middle, *middle), pillars - (*middle, 0.0))]
        rays = [tuple(np.tile((0, count), (len(part), 1)) for part in cuts[0])]
        for k in np.flatnonzero(away < reach + moved).tolist():
            if k != own:
                a, b, d, e = sides[k]
                template = (segments[a:b], discs[d:e])
                poses = between(*self._track(k), middles) - (*middle, 0.0)
                cuts.append(at_each_pose(template, poses))
                rays.append(tuple(np.repeat(spans, len(part), axis=0) for part in template))
        segment_rays, disc_rays = (np.vstack(each) for each in zip(*rays, strict=True))
        cut = stack(cuts)
        ranges = raycast.raycast_each(
            *cut, places, angles, reach, segment_rays=segment_rays, disc_rays=disc_rays, backend="numpy"
        )
        return measured(lidar, ranges if noise is None else ranges + noise)

    def _track(self, number: int) -> tuple[Floats, Floats]:
        rows = slice(self._starts[number], self._starts[number + 1])
        return self._times[rows], self._poses[rows]

    def _update_tracks(self, duration: float) -> None:
        """Compute the tracks of all bodies during the last `duration` seconds."""
        population = self._population
        moment = (population.now, population.changed, duration)
        if moment == self._moment:
            return
        self._moment = moment
        self._cuts: dict[float, tuple[Ints, Floats, Floats]] = {}
        grid = [population.now - duration * part for part in PARTS]
        self._numbers: dict[str, int] = {}
        starts = [0]
        times: list[float] = []
        poses: list[Pose] = []
        around: list[tuple[float, float, float]] = []
        for name, pose, reach, pose_on_leg in self._moving_bodies():
            track = population.trails.track(name, grid, pose, pose_on_leg)
            if track is not None:
                self._numbers[name] = len(self._numbers)
                times += track[0]
                poses += track[1]
                starts.append(len(times))
                around.append(_around(track[1], reach))
        self._starts, self._times = np.array(starts, dtype=np.int64), np.array(times)
        self._poses, self._around = np.array(poses).reshape(-1, 3), np.array(around).reshape(-1, 3)
        moving = self._numbers
        self._stationary_robots = [each for each in population.robots.values() if each.name not in moving]
        self._crates: list[Crate] = [
            each for each in population.contacts.crates if each.shown and each.obstacle.name not in moving
        ]
        self._movers: list[Mover] = [each for each in population.movers.values() if each.obstacle.name not in moving]

    def _moving_bodies(self) -> Iterator[tuple[str, Pose, float, PoseOnLeg | None]]:
        """Yield each body that may move: its name, pose, reach [m], and a function for its former poses."""
        population = self._population
        for robot in population.robots.values():
            yield robot.name, robot.pose, robot.model.extent, robot.pose_on_leg
        for mover in population.movers.values():
            yield mover.obstacle.name, mover.pose, mover.reach, mover.pose_on_leg
        for crate in population.contacts.crates:
            if crate.shown:
                yield crate.obstacle.name, crate.pose, crate.reach, None

    def _stationary_section(self, viewer: Robot, lidar: LidarModel) -> CrossSection:
        """Return the cross-section of the objects that did not move, as far as the laser can see them."""
        robots, moved, moment = self._stationary_robots, 0.0, (self._moment, "")
        own = self._numbers.get(viewer.name)
        if own is not None:
            robots, moment = [viewer, *robots], (self._moment, viewer.name)
            moved = 2 * (self._around[own, 2] + math.hypot(*lidar.mount[:2]))
        return self._population.laser_view.of(lidar, viewer, robots, self._crates, self._movers, moment, moved)

    def _outlines(self, height: float) -> tuple[Ints, Floats, Floats]:
        """Return the outlines of the bodies that moved, each in its own frame: row ranges, segments and discs."""
        if height not in self._cuts:
            cuts = [self._outline(name, height) for name in self._numbers]
            sides = np.zeros((len(cuts), 4), dtype=np.int64)
            for column, part in ((0, 0), (2, 1)):
                sides[:, column + 1] = np.cumsum([len(cut[part]) for cut in cuts])
                sides[1:, column] = sides[:-1, column + 1]
            self._cuts[height] = (sides, *stack(cuts))
        return self._cuts[height]

    def _outline(self, name: str, height: float) -> CrossSection:
        population = self._population
        if name in population.robots:
            return population.laser_view.template(population.robots[name].model, height)
        owner = population.movers[name] if name in population.movers else population.contacts.loose[name]
        return obstacle_section(owner.obstacle, height, (0.0, 0.0, 0.0))


def _around(poses: Sequence[Pose], reach: float) -> tuple[float, float, float]:
    """Return a circle (x, y, radius) that contains a body of this reach [m] on arcs from pose to pose."""
    x, y, _ = poses[len(poses) // 2]
    radius = max(math.hypot(px - x, py - y) for px, py, _ in poses)
    bulge = 0.0  # no point of an arc is farther than half its length from the nearer end
    for (x1, y1, begin), (x2, y2, end) in itertools.pairwise(poses):
        half = abs(end - begin) / 2
        if half > math.pi / 2:
            return (x, y, math.inf)
        chord = math.hypot(x2 - x1, y2 - y1)
        bulge = max(bulge, chord / 2 * (half / math.sin(half) if half else 1.0))
    return (x, y, reach + radius + bulge)
