"""The part of a world that each laser can see, with caches.

Caches hold, for each height, the cross-section of the fixed obstacles and of each robot model in the model's own frame.
The cross-sections of the robots at their current poses are computed once for all lasers at the same height.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.world import Obstacle, World

from .cross_sections import NOTHING, CrossSection, Floats, at_each_pose, obstacle_section, robot_section, stack
from .nearby import Nearby, boxes_around

if TYPE_CHECKING:
    from .bodies import Crate
    from .movers import Mover
    from .robot import Robot

Ints = NDArray[np.intp]

CULL_ABOVE_SEGMENTS = 200
"""Above this number of segments, only those around a laser are cast against."""

MARGIN = 1.0
"""Distance a laser moves before the segments around it are looked up again [m]."""


class RobotSections:
    """The cross-sections of many robots at one moment and height, and the owner of each segment and disc."""

    def __init__(
        self, models: Sequence[RobotModel], poses: Floats, template: Callable[[RobotModel], CrossSection]
    ) -> None:
        self.positions = poses[:, :2]
        self.radii = np.zeros(len(models))
        kinds: dict[int, list[int]] = {}
        for i, model in enumerate(models):
            kinds.setdefault(id(model), []).append(i)
        segments_of, discs_of = [NOTHING[0]], [NOTHING[1]]
        owner_of_segment: list[Ints] = [np.empty(0, dtype=np.intp)]
        owner_of_disc: list[Ints] = [np.empty(0, dtype=np.intp)]
        for members in kinds.values():
            which, outline = np.array(members), template(models[members[0]])
            segments, discs = at_each_pose(outline, poses[which])
            segments_of.append(segments)
            discs_of.append(discs)
            owner_of_segment.append(np.repeat(which, len(outline[0])))
            owner_of_disc.append(np.repeat(which, len(outline[1])))
            self.radii[which] = _reach(outline)
        self.segments, self.owner_of_segment = np.vstack(segments_of), np.concatenate(owner_of_segment)
        self.discs, self.owner_of_disc = np.vstack(discs_of), np.concatenate(owner_of_disc)

    def around(self, x: float, y: float, radius: float, own: int) -> CrossSection:
        """Return the sections of the robots within `radius` [m] of a position, except robot number `own` (-1: none)."""
        away = np.hypot(self.positions[:, 0] - x, self.positions[:, 1] - y)
        near = away <= radius + self.radii
        if own >= 0:
            near[own] = False
        return self.segments[near[self.owner_of_segment]], self.discs[near[self.owner_of_disc]]


def _reach(outline: CrossSection) -> float:
    segments, discs = outline
    return max(
        float(np.hypot(segments[:, ::2], segments[:, 1::2]).max(initial=0.0)),
        float((np.hypot(discs[:, 0], discs[:, 1]) + discs[:, 2]).max(initial=0.0)),
    )


class LaserView:
    """The cross-sections that the lasers of one world see; unchanging ones are cached."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._fixed = {obstacle.name: obstacle for obstacle in world.obstacles if obstacle.fixed}
        self._solid: dict[float, CrossSection] = {}
        self._cuts: dict[str, dict[float, CrossSection]] = {}
        self._nearby: dict[float, Nearby] = {}
        self._around: dict[tuple[str, float, float], tuple[float, float, Floats]] = {}
        self._movable: dict[str, dict[float, tuple[Obstacle, Pose, CrossSection]]] = {}
        self._templates: dict[tuple[int, float], tuple[RobotModel, CrossSection]] = {}
        self._robots: tuple[Hashable, dict[float, RobotSections]] = (None, {})

    def insert(self, obstacle: Obstacle) -> None:
        """Add a fixed obstacle."""
        self._fixed[obstacle.name] = obstacle
        for height, solid in self._solid.items():
            self._solid[height] = stack([solid, self._cut(obstacle, height)])
        self._invalidate_nearby()

    def remove(self, name: str) -> None:
        """Remove an obstacle; harmless if it does not exist."""
        self._movable.pop(name, None)
        if self._fixed.pop(name, None) is not None:
            self._cuts.pop(name, None)
            self._solid.clear()
            self._invalidate_nearby()

    def _invalidate_nearby(self) -> None:
        self._nearby.clear()
        self._around.clear()

    def _cut(self, obstacle: Obstacle, height: float) -> CrossSection:
        cuts = self._cuts.setdefault(obstacle.name, {})
        if height not in cuts:
            cuts[height] = obstacle_section(obstacle, height)
        return cuts[height]

    def forget_viewer(self, name: str) -> None:
        """Drop the cache of a removed robot's lasers."""
        self._around = {key: kept for key, kept in self._around.items() if key[0] != name}

    def solid(self, height: float) -> CrossSection:
        """Return the cross-section of all fixed obstacles and walls at this height [m]."""
        if height not in self._solid:
            world = self.world
            cuts = [self._cut(obstacle, height) for obstacle in self._fixed.values()]
            if world.wall_height >= height:
                cuts.insert(0, (world.walls.reshape(-1, 4), NOTHING[1]))
            self._solid[height] = stack(cuts)
        return self._solid[height]

    def fixed_around(self, viewer: str, x: float, y: float, height: float, radius: float) -> CrossSection:
        """Return the fixed obstacles at this height within `radius` [m] of a laser, and some that are farther away."""
        segments, discs = self.solid(height)
        if len(segments) <= CULL_ABOVE_SEGMENTS or math.isinf(radius):
            return segments, discs
        key = (viewer, height, radius)
        kept = self._around.get(key)
        if kept is None or math.hypot(kept[0] - x, kept[1] - y) > MARGIN:
            if height not in self._nearby:
                self._nearby[height] = Nearby(boxes_around(segments))
            near = self._nearby[height].within(x, y, radius + 2 * MARGIN)
            kept = self._around[key] = (x, y, np.ascontiguousarray(segments[near]))
        return kept[2], discs

    def movable(self, obstacle: Obstacle, height: float, pose: Pose) -> CrossSection:
        """Return the cross-section of an obstacle that may have moved."""
        by_height = self._movable.setdefault(obstacle.name, {})
        kept = by_height.get(height)
        if kept is None or kept[0] is not obstacle or kept[1] != pose:
            kept = by_height[height] = (obstacle, pose, obstacle_section(obstacle, height, pose))
        return kept[2]

    def template(self, model: RobotModel, height: float) -> CrossSection:
        """Return the cross-section of a robot model at this height [m], in the model's own frame."""
        key = (id(model), height)
        if key not in self._templates:
            # kept with the model, so that its id is not reused
            self._templates[key] = (model, robot_section(model, height))
        return self._templates[key][1]

    def robots(self, moment: Hashable, height: float, robots: Sequence[Robot]) -> RobotSections:
        """Return the cross-sections of all robots, computed once for each height and `moment`.

        `moment` is a value that changes whenever a pose does.
        """
        if self._robots[0] != moment:
            self._robots = (moment, {})
        by_height = self._robots[1]
        if height not in by_height:
            places = np.array([each.pose for each in robots]).reshape(-1, 3)
            models = [each.model for each in robots]
            by_height[height] = RobotSections(models, places, lambda model: self.template(model, height))
        return by_height[height]

    def of(
        self,
        laser: LidarModel,
        viewer: Robot,
        robots: Sequence[Robot],
        crates: Iterable[Crate],
        movers: Iterable[Mover],
        moment: Hashable,
        moved: float = 0.0,
    ) -> CrossSection:
        """Return the cross-section of all objects within range of a robot's laser, in the map frame.

        It includes the other robots. `moved` is the distance [m] that the robot may have moved during the measurement.
        """
        x, y, theta = viewer.pose
        c, s = math.cos(theta), math.sin(theta)
        mx, my, height = laser.mount
        x, y = x + c * mx - s * my, y + s * mx + c * my
        radius = laser.range_max + 6 * laser.noise
        # The margin in `fixed_around` covers a `moved` below MARGIN, as at normal speeds; enlarge the radius only by
        # whole MARGINs, so that cache entries are reused.
        found = [self.fixed_around(viewer.name, x, y, height, radius + math.floor(moved / MARGIN) * MARGIN)]
        found += [self.movable(crate.obstacle, height, crate.pose) for crate in crates]
        found += [self.movable(mover.obstacle, height, mover.pose) for mover in movers]
        if len(robots) > 1:
            own = next(i for i, each in enumerate(robots) if each is viewer)
            found.append(self.robots(moment, height, robots).around(x, y, radius + moved, own))
        return stack(found)
