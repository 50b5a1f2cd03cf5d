"""What lasers see: the cross-section of a world, its things and its robots at the height of a laser.

Straight sides are segments (n, 4), what is round discs (m, 3), as `rosmini.geometry.raycast` wants them. What
does not change is made once: fixed things for each height, the outline of each model for each height in the
model's own frame. Robots at one moment are cut once, whoever of them looks.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose, compose
from rosmini.sim.models import LidarModel, RobotModel
from rosmini.sim.shapes import Part, Simple, Sphere, simple_parts
from rosmini.sim.world import Box, Obstacle, Polygon, World, edges

from .nearby import Nearby, boxes_around

if TYPE_CHECKING:
    from .bodies import Crate
    from .movers import Mover
    from .robot import Robot

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]
Cut = tuple[Floats, Floats]
"""Segments (n, 4) and discs (m, 3)."""

NOTHING: Cut = (np.empty((0, 4)), np.empty((0, 3)))

MANY = 200
"""Above this number of segments, only those around a laser are looked at."""

MARGIN = 1.0
"""So far [m] a laser moves until it is looked again which segments are around it."""


def cut(parts: Iterable[tuple[Simple, Pose]], up: float) -> Cut:
    """The cross-section of shapes at their poses, `up` metres above where they begin."""
    sides, discs = [], []
    for shape, pose in parts:
        if isinstance(shape, (Box, Polygon)):
            sides.append(edges(shape.outline) if pose == (0.0, 0.0, 0.0) else edges(_placed(shape, pose)))
        else:
            radius = shape.cut(up) if isinstance(shape, Sphere) else shape.radius
            if radius > 0:
                discs.append((pose[0], pose[1], radius))
    return np.vstack([NOTHING[0], *sides]), np.array(discs, dtype=float).reshape(-1, 3)


def _placed(shape: Box | Polygon, pose: Pose) -> Floats:
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    outline: Floats = shape.outline @ np.array([[c, s], [-s, c]]) + (x, y)
    return outline


def cut_obstacle(obstacle: Obstacle, height: float, pose: Pose | None = None) -> Cut:
    """The cross-section of an obstacle at so much [m] above the ground, where it is or at `pose`."""
    if not obstacle.bottom <= height <= obstacle.height:
        return NOTHING
    return cut(
        simple_parts(obstacle.shape, obstacle.pose if pose is None else pose), height - obstacle.bottom
    )


def cut_model(model: RobotModel, height: float) -> Cut:
    """The cross-section of a robot at so much [m] above the ground, in its own frame."""
    found = [
        cut(simple_parts(part.shape, part.pose), height - part.bottom)
        for part in model.solid
        if part.bottom <= height <= part.top
    ]
    return stacked(found)


def stacked(cuts: Sequence[Cut]) -> Cut:
    """Several cross-sections as one."""
    if len(cuts) == 1:
        return cuts[0]
    return (
        np.vstack([NOTHING[0], *(segments for segments, _ in cuts if len(segments))]),
        np.vstack([NOTHING[1], *(discs for _, discs in cuts if len(discs))]),
    )


def at_poses(template: Cut, poses: Floats) -> Cut:
    """A cross-section at each of the poses (k, 3): segments (k * n, 4) and discs (k * m, 3), pose by pose."""
    x, y, c, s = poses[:, :1], poses[:, 1:2], np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
    (segments, discs), count = template, len(poses)
    sides, rounds = np.empty((count, len(segments), 4)), np.empty((count, len(discs), 3))
    for table, source, columns in ((sides, segments, (0, 2)), (rounds, discs, (0,))):
        for i in columns:
            table[:, :, i] = x + c * source[:, i] - s * source[:, i + 1]
            table[:, :, i + 1] = y + s * source[:, i] + c * source[:, i + 1]
    rounds[:, :, 2] = discs[:, 2]
    return sides.reshape(-1, 4), rounds.reshape(-1, 3)


class Crowd:
    """The cross-sections of many robots at one moment and height, each with whose it is."""

    def __init__(
        self, models: Sequence[RobotModel], poses: Floats, template: Callable[[RobotModel], Cut]
    ) -> None:
        self.places = poses[:, :2]
        self.reaches = np.zeros(len(models))
        kinds: dict[int, list[int]] = {}
        for i, model in enumerate(models):
            kinds.setdefault(id(model), []).append(i)
        sides, rounds = [NOTHING[0]], [NOTHING[1]]
        of_side: list[Ints] = [np.empty(0, dtype=np.intp)]
        of_round: list[Ints] = [np.empty(0, dtype=np.intp)]
        for members in kinds.values():
            which, outline = np.array(members), template(models[members[0]])
            segments, discs = at_poses(outline, poses[which])
            sides.append(segments)
            rounds.append(discs)
            of_side.append(np.repeat(which, len(outline[0])))
            of_round.append(np.repeat(which, len(outline[1])))
            self.reaches[which] = _reach(outline)
        self.segments, self.of_segment = np.vstack(sides), np.concatenate(of_side)
        self.discs, self.of_disc = np.vstack(rounds), np.concatenate(of_round)

    def around(self, x: float, y: float, radius: float, own: int) -> Cut:
        """What of the others is so near [m] to a place."""
        away = np.hypot(self.places[:, 0] - x, self.places[:, 1] - y)
        near = away <= radius + self.reaches
        if own >= 0:
            near[own] = False
        return self.segments[near[self.of_segment]], self.discs[near[self.of_disc]]


def _reach(outline: Cut) -> float:
    segments, discs = outline
    return max(
        float(np.hypot(segments[:, ::2], segments[:, 1::2]).max(initial=0.0)),
        float((np.hypot(discs[:, 0], discs[:, 1]) + discs[:, 2]).max(initial=0.0)),
    )


class Sights:
    """What lasers see in one world; it remembers what does not change."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._fixed = {obstacle.name: obstacle for obstacle in world.obstacles if obstacle.fixed}
        self._solid: dict[float, Cut] = {}
        self._cuts: dict[str, dict[float, Cut]] = {}
        self._nearby: dict[float, Nearby] = {}
        self._around: dict[tuple[str, float, float], tuple[float, float, Floats]] = {}
        self._things: dict[str, dict[float, tuple[Obstacle, Pose, Cut]]] = {}
        self._templates: dict[tuple[int, float], tuple[RobotModel, Cut]] = {}
        self._crowds: tuple[Hashable, dict[float, Crowd]] = (None, {})

    def insert(self, obstacle: Obstacle) -> None:
        """Learn of another fixed obstacle."""
        self._fixed[obstacle.name] = obstacle
        for height, solid in self._solid.items():
            self._solid[height] = stacked([solid, self._cut(obstacle, height)])
        self._look_again()

    def remove(self, name: str) -> None:
        """Forget an obstacle that is gone, if it was seen."""
        self._things.pop(name, None)
        if self._fixed.pop(name, None) is not None:
            self._cuts.pop(name, None)
            self._solid.clear()
            self._look_again()

    def _look_again(self) -> None:
        self._nearby.clear()
        self._around.clear()

    def _cut(self, obstacle: Obstacle, height: float) -> Cut:
        cuts = self._cuts.setdefault(obstacle.name, {})
        if height not in cuts:
            cuts[height] = cut_obstacle(obstacle, height)
        return cuts[height]

    def forget_viewer(self, name: str) -> None:
        """Forget what was around a laser that is gone."""
        self._around = {key: kept for key, kept in self._around.items() if key[0] != name}

    def solid(self, height: float) -> Cut:
        """The fixed things at this height, all of them."""
        if height not in self._solid:
            world = self.world
            cuts = [self._cut(obstacle, height) for obstacle in self._fixed.values()]
            if world.wall_height >= height:
                cuts.insert(0, (world.walls.reshape(-1, 4), NOTHING[1]))
            self._solid[height] = stacked(cuts)
        return self._solid[height]

    def fixed_around(self, viewer: str, x: float, y: float, height: float, radius: float) -> Cut:
        """The fixed things at this height that may be so near [m] to a laser, and perhaps some more."""
        segments, discs = self.solid(height)
        if len(segments) <= MANY or math.isinf(radius):
            return segments, discs
        key = (viewer, height, radius)
        kept = self._around.get(key)
        if kept is None or math.hypot(kept[0] - x, kept[1] - y) > MARGIN:
            if height not in self._nearby:
                self._nearby[height] = Nearby(boxes_around(segments))
            near = self._nearby[height].within(x, y, radius + 2 * MARGIN)
            kept = self._around[key] = (x, y, np.ascontiguousarray(segments[near]))
        return kept[2], discs

    def thing(self, obstacle: Obstacle, height: float, pose: Pose) -> Cut:
        """A thing that may be elsewhere than it was."""
        things = self._things.setdefault(obstacle.name, {})
        kept = things.get(height)
        if kept is None or kept[0] is not obstacle or kept[1] != pose:
            kept = things[height] = (obstacle, pose, cut_obstacle(obstacle, height, pose))
        return kept[2]

    def template(self, model: RobotModel, height: float) -> Cut:
        """The cross-section of a robot in its own frame."""
        key = (id(model), height)
        if key not in self._templates:
            self._templates[key] = (model, cut_model(model, height))  # with the model its id stays its own
        return self._templates[key][1]

    def crowd(self, moment: Hashable, height: float, robots: Sequence[Robot]) -> Crowd:
        """The robots at one moment, made once for each height; `moment` is another whenever any pose is."""
        if self._crowds[0] != moment:
            self._crowds = (moment, {})
        crowds = self._crowds[1]
        if height not in crowds:
            places = np.array([each.pose for each in robots]).reshape(-1, 3)
            models = [each.model for each in robots]
            crowds[height] = Crowd(models, places, lambda model: self.template(model, height))
        return crowds[height]

    def of(
        self,
        laser: LidarModel,
        viewer: Robot,
        robots: Sequence[Robot],
        crates: Iterable[Crate],
        movers: Iterable[Mover],
        moment: Hashable,
        moved: float = 0.0,
    ) -> Cut:
        """What a robot's laser can see: all that may be within its reach, other robots too, in the frame map.

        So much [m] it may have moved while it measured.
        """
        x, y, theta = viewer.pose
        c, s = math.cos(theta), math.sin(theta)
        mx, my, height = laser.mount
        x, y = x + c * mx - s * my, y + s * mx + c * my
        radius = laser.range_max + 6 * laser.noise
        # the margin of what is kept covers all but a great haste
        found = [self.fixed_around(viewer.name, x, y, height, radius + math.floor(moved / MARGIN) * MARGIN)]
        found += [self.thing(crate.obstacle, height, crate.pose) for crate in crates]
        found += [self.thing(mover.obstacle, height, mover.pose) for mover in movers]
        if len(robots) > 1:
            own = next(i for i, each in enumerate(robots) if each is viewer)
            found.append(self.crowd(moment, height, robots).around(x, y, radius + moved, own))
        return stacked(found)


def parts_of(obstacle: Obstacle, pose: Pose | None = None) -> Part:
    """An obstacle as a part of the world, where it is or at `pose`."""
    where = obstacle.pose if pose is None else pose
    return Part(obstacle.shape, where, obstacle.bottom, obstacle.height, obstacle.colour, obstacle.name)


def parts_of_robot(robot: Robot) -> list[Part]:
    """The parts of a robot where it is now."""
    height = robot.model.height
    return [
        replace(
            part,
            pose=compose(robot.pose, part.pose),
            top=part.top if math.isfinite(part.top) else height,
            name=robot.name,
        )
        for part in robot.model.solid
    ]
