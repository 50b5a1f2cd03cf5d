"""What a laser measures that needs its time for a revolution: each beam from where the robot was at the time of that beam, and of what stood there then.

Exact poses are found at `GRID` + 1 times of a revolution, and between them the robot is taken to move along arcs. So its beams start exactly where they
should while its speeds are constant; where they change, at most a T^2 / (8 GRID^2) beside it with a the acceleration and T the time of a revolution: a
Burger that begins to turn as fast as it can, with 12.5 rad/s^2, is off by 0.6 milliradians for a moment. Others that move are put for each
`TOGETHER` beams to where they are in the middle of them: off by 2.2 ms of their way, half a millimetre for a Burger, and 3 mm for who walks at 1.4 m/s.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.raycast import raycast_each
from rosmini.sim.models import LidarModel
from rosmini.sim.sensors.lidar import measured

from .sights import Cut, at_poses, cut_obstacle, stacked
from .trails import Later, between

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.geometry.poses import Pose

    from .bodies import Crate
    from .engine import Engine
    from .movers import Mover
    from .robot import Robot

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GRID = 10
"""At so many times and one of a revolution poses are exact."""

PARTS = np.arange(GRID, -1, -1) / GRID
"""How much of a revolution is left at these times."""

TOGETHER = 8
"""For so many beams, one after the other, what moves stands still."""


class Sweeps:
    """What moved in an engine during the last revolution, found once for all lasers that turn in step."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._moment: tuple[float, int, float] | None = None

    def scan(
        self, viewer: Robot, lidar: LidarModel, beam_time: float, noise: Floats | None
    ) -> tuple[Floats, Floats]:
        """The ranges (beams,) [m], and where the robot was at each beam (beams, 3): the first is measured now, each further one `beam_time` [s] before."""
        engine, count = self._engine, lidar.beams
        self._turn(beam_time * count)
        track = self._tracks.get(viewer.name)
        if not self._tracks:
            return engine.scan(viewer.name, noise, lidar), np.tile(viewer.pose, (count, 1))
        beams = np.arange(count, dtype=np.float64)
        if track is None:
            poses = np.tile(viewer.pose, (count, 1))
        else:
            poses = between(self._grid, track, engine.now - beam_time * beams)
        angles = poses[:, 2] + (lidar.yaw + lidar.angle_min) + lidar.increment * beams
        c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        mx, my, height = lidar.mount
        places = np.column_stack([poses[:, 0] + c * mx - s * my, poses[:, 1] + s * mx + c * my])
        reach = lidar.range_max if noise is None else lidar.range_max + 6 * lidar.noise
        moved = float(np.hypot(*(places - places[0]).T).max())
        still = engine.sights.of(lidar, viewer, *self._still(viewer), self._moment, moved)
        near = self._near(viewer, height, places[0], reach + moved, beam_time, count)
        segments, discs = stacked([still, *(each for each, _ in near)])
        rays = [
            np.vstack([np.tile((0, count), (len(still[i]), 1)), *(of[i] for _, of in near)]) if near else None
            for i in (0, 1)
        ]
        ranges = raycast_each(segments, discs, places, angles, reach, segment_rays=rays[0], disc_rays=rays[1])
        return measured(lidar, ranges if noise is None else ranges + noise), poses

    def _turn(self, duration: float) -> None:
        """Find where all were during the last `duration` seconds."""
        engine = self._engine
        moment = (engine.now, engine.changed, duration)
        if moment == self._moment:
            return
        self._moment = moment
        self._grid = engine.now - duration * PARTS
        self._cuts: dict[tuple[str, float, int], tuple[Cut, tuple[Ints, Ints]]] = {}
        times = self._grid.tolist()
        self._tracks: dict[str, Floats] = {}
        sizes: list[float] = []
        for name, pose, reach, later in self._all():
            track = engine.trails.track(name, times, engine.now, pose, later)
            if not (track == pose).all():
                self._tracks[name] = track
                sizes.append(reach + float(np.hypot(*(track - track[GRID // 2])[:, :2].T).max()))
        self._names, self._sizes = list(self._tracks), np.array(sizes)
        self._middles = np.array([track[GRID // 2, :2] for track in self._tracks.values()]).reshape(-1, 2)

    def _all(self) -> Iterator[tuple[str, Pose, float, Later | None]]:
        """All that may move: where it is, how far from there it reaches [m], and what tells where it was."""
        engine = self._engine
        for robot in engine.robots.values():
            yield robot.name, robot.pose, robot.model.extent, robot.later
        for mover in engine.movers.values():
            yield mover.obstacle.name, mover.pose, mover.reach, mover.later
        for crate in engine.contacts.crates:
            if crate.shown:
                yield crate.obstacle.name, crate.pose, crate.reach, None

    def _still(self, viewer: Robot) -> tuple[list[Robot], list[Crate], list[Mover]]:
        """Who did not move, and the viewer."""
        engine, moving = self._engine, self._tracks
        return (
            [each for each in engine.robots.values() if each is viewer or each.name not in moving],
            [each for each in engine.contacts.crates if each.shown and each.obstacle.name not in moving],
            [each for each in engine.movers.values() if each.obstacle.name not in moving],
        )

    def _near(
        self, viewer: Robot, height: float, place: Floats, reach: float, beam_time: float, count: int
    ) -> list[tuple[Cut, tuple[Ints, Ints]]]:
        """What moved within reach, but for the viewer: its cross-section at each time, and which beams see that of which time."""
        if self._names in ([], [viewer.name]):
            return []
        away = np.hypot(*(self._middles - place).T) - self._sizes
        found = []
        for which in np.flatnonzero(away < reach).tolist():
            name = self._names[which]
            if name == viewer.name:
                continue
            key = (name, height, count)
            if key not in self._cuts:
                self._cuts[key] = self._cut(name, height, beam_time, count)
            found.append(self._cuts[key])
        return found

    def _cut(self, name: str, height: float, beam_time: float, count: int) -> tuple[Cut, tuple[Ints, Ints]]:
        engine = self._engine
        if name in engine.robots:
            template = engine.sights.template(engine.robots[name].model, height)
        else:
            template = cut_obstacle(engine.obstacle(name), height, (0.0, 0.0, 0.0))
        first = np.arange(0, count, TOGETHER)
        beams = np.column_stack([first, np.minimum(first + TOGETHER, count)])
        middles = engine.now - beam_time * (beams.sum(axis=1) - 1) / 2
        rays = tuple(np.repeat(beams, len(part), axis=0) for part in template)
        return at_poses(template, between(self._grid, self._tracks[name], middles)), (rays[0], rays[1])
