"""A robot's surroundings: walls, obstacles and starts, seen from above.

A world is plain data in metres and radians, in the frame `map`: x to the right, y up, angles counter-clockwise (REP
103). Whatever its source (Python, a ROS map, a Gazebo or a Stage file), the engine, the lidar and the
pictures use this structure.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import polygons
from rosmini.core.geometry.poses import Pose
from rosmini.sim.geometry.raycast import raycast

from .fixtures import Fixtures, Footprint
from .motion import Door, Motion, Walk
from .shapes import (
    COLOURS,
    ROUND,
    Box,
    Colour,
    Compound,
    Cylinder,
    Polygon,
    Shape,
    Simple,
    Sphere,
    WorldError,
    colour_problem,
    is_finite,
    outline_at,
    pose_problem,
    positive_problem,
    shape_problem,
    simple_parts,
)

__all__ = [
    "COLOURS",
    "Box",
    "Colour",
    "Compound",
    "Cylinder",
    "Door",
    "Footprint",
    "Motion",
    "Obstacle",
    "Polygon",
    "Pose",
    "Shape",
    "Sphere",
    "Walk",
    "World",
    "WorldError",
    "edges",
]

RAYS = 72
"""Number of directions in which a world must be bounded at its start in order to have an outside."""

FAR = 10_000.0
"""Distance that an open world extends beyond its contents [m]."""


@dataclass(frozen=True)
class Obstacle:
    """An obstacle in a world: fixed, or movable by robots if it has a mass, or moving by itself if it has a motion.

    Raises `WorldError`, which names the obstacle and the field, for a number that is not finite, a size or a mass that
    is not positive, an invalid colour, a top that is not above the bottom, and a polygon that crosses itself or
    whose corners are clockwise.
    """

    name: str
    shape: Shape
    pose: Pose = (0.0, 0.0, 0.0)
    height: float = 0.5
    """Height of its top above the ground [m]; a laser above it does not see it.

    For a sphere it follows from the radius.
    """
    colour: Colour = "grey"
    mass: float | None = None
    """Mass [kg]; None: it cannot be pushed."""
    bottom: float = 0.0
    """Height of its lower end above the ground [m]; lower robots and lasers pass under it."""
    motion: Motion | None = None
    """Its own motion; None: it does not move by itself."""
    drag: float | None = None
    """Friction of a movable obstacle on the ground; None: that of the engine, 0.5."""
    restitution: float = 0.0
    """Coefficient of restitution of a movable obstacle, from 0 to 1.

    Between two movable obstacles the product applies.
    """
    passable: bool = False
    """True if robots and other obstacles pass through it; lasers and cameras see it nevertheless."""
    seen_by_lasers: bool = True
    """False: lasers see through it."""

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise WorldError(f"an obstacle has the name {self.name!r}; every obstacle needs a name")
        problem = (
            shape_problem(self.shape)
            or pose_problem("pose", self.pose)
            or (f"bottom is {self.bottom!r}; it must be a finite number" if not is_finite(self.bottom) else "")
        )
        if not problem and isinstance(self.shape, Sphere):
            object.__setattr__(self, "height", self.bottom + 2 * self.shape.radius)
        problem = (
            problem
            or positive_problem("height", self.height)
            or (
                f"its bottom is at {self.bottom!r} and its height is {self.height!r}; the top must be above the bottom"
                if self.height <= self.bottom
                else ""
            )
            or (positive_problem("mass", self.mass) if self.mass is not None else "")
            or colour_problem(self.colour)
            or ("" if self.drag is None else _range_problem("drag", self.drag, math.inf))
            or _range_problem("restitution", self.restitution, 1.0)
            or self._motion_problem()
            or (
                "robots pass through it, so it cannot have a mass or a motion"
                if self.passable and not self.fixed
                else ""
            )
        )
        if problem:
            raise WorldError(f"the obstacle {self.name!r} is not possible: {problem}")

    def _motion_problem(self) -> str:
        if self.motion is None:
            return ""
        if not isinstance(self.motion, Motion):
            return f"motion is {self.motion!r}; it must be a Walk or a Door"
        return "it has a mass, so robots push it, and a motion of its own; it can have one of them" if self.mass else ""

    @property
    def movable(self) -> bool:
        """True if a robot can push it."""
        return self.mass is not None

    @property
    def fixed(self) -> bool:
        """True if it never moves."""
        return self.mass is None and self.motion is None

    def at(self, t: float) -> Pose:
        """Return its pose at the time t [s] of its own motion, or its pose if it has no motion."""
        return self.pose if self.motion is None else self.motion.pose_at(t, self.pose)

    def parts(self) -> list[tuple[Simple, Pose]]:
        """Return its simple shapes, each with its pose in the world."""
        return list(simple_parts(self.shape, self.pose))

    def outline(self) -> NDArray[np.float64]:
        """Return the corners (n, 2) in the world; none for a round shape or a compound."""
        return outline_at(self.shape, self.pose) if isinstance(self.shape, (Box, Polygon)) else np.empty((0, 2))


def edges(outline: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the sides (n, 4) of a closed outline (n, 2), each as x1, y1, x2, y2."""
    return polygons.sides_of(outline)


@dataclass(frozen=True, eq=False)
class World:
    """A flat world."""

    name: str
    obstacles: tuple[Obstacle, ...] = ()
    walls: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 4)))
    """Thin walls (n, 4), each a segment x1, y1, x2, y2 [m], for example traced from a map."""
    wall_height: float = 0.5
    """Height of the walls [m]; a laser above it does not see them."""
    starts: tuple[Pose, ...] = ((0.0, 0.0, 0.0),)
    """Default starts of robots, in this order."""
    title: str = ""
    """A short description for captions."""
    solid: bool = False
    """True if walls are closed outlines of solid areas (by the even-odd rule), as in a traced map."""
    passable_walls: bool = False
    """True if robots pass through the walls; lasers and cameras see them nevertheless."""

    def __post_init__(self) -> None:
        problem = (
            ("it needs a name" if not isinstance(self.name, str) or not self.name.strip() else "")
            or self._obstacles_problem()
            or positive_problem("wall_height", self.wall_height)
            or self._walls_problem()
            or ("starts: it needs one at least" if not self.starts else "")
            or "".join(pose_problem(f"starts[{i}]", pose) for i, pose in enumerate(self.starts))
        )
        if problem:
            raise WorldError(f"the world {self.name!r} is not possible: {problem}")

    def _obstacles_problem(self) -> str:
        object.__setattr__(self, "obstacles", tuple(self.obstacles))
        for each in self.obstacles:
            if not isinstance(each, Obstacle):
                return f"obstacles holds {each!r}, which is no Obstacle"
        twice = [name for name, count in Counter(o.name for o in self.obstacles).items() if count > 1]
        return f"two obstacles have the name {twice[0]!r}" if twice else ""

    def _walls_problem(self) -> str:
        try:
            walls = np.array(self.walls, dtype=np.float64)
        except (TypeError, ValueError):
            return "walls must be a table of numbers (n, 4), each row x1, y1, x2, y2"
        if not walls.size:
            walls = walls.reshape(0, 4)
        if walls.ndim != 2 or walls.shape[1] != 4:
            return f"walls must be a table (n, 4), each row x1, y1, x2, y2, not {walls.shape}"
        wrong = np.flatnonzero(~np.isfinite(walls).all(axis=1))
        if len(wrong):
            return f"walls[{wrong[0]}] is {walls[wrong[0]].tolist()}; its numbers must be finite"
        walls.flags.writeable = False
        object.__setattr__(self, "walls", walls)
        if not self.solid:
            return ""
        ends, counts = np.unique(walls.reshape(-1, 2), axis=0, return_counts=True)
        if (counts % 2).any():
            x, y = ends[counts % 2 == 1][0]
            return f"its walls are solid but not closed: one ends at ({x:.3f}, {y:.3f}), where no other begins"
        return ""

    def __repr__(self) -> str:
        return f"<World {self.name}: {_count(len(self.walls), 'wall')}, {_count(len(self.obstacles), 'obstacle')}>"

    @property
    def hard_walls(self) -> NDArray[np.float64]:
        """The walls (n, 4) that stop robots."""
        return self.walls[:0] if self.passable_walls else self.walls

    @cached_property
    def segments(self) -> NDArray[np.float64]:
        """All fixed straight sides (n, 4): walls, and the sides of fixed boxes and polygons."""
        sides = [
            edges(outline_at(shape, pose))
            for o in self.obstacles
            if o.fixed
            for shape, pose in o.parts()
            if isinstance(shape, (Box, Polygon))
        ]
        return np.vstack([self.walls.reshape(-1, 4), *sides])

    @cached_property
    def discs(self) -> NDArray[np.float64]:
        """All fixed cylinders and spheres (n, 3), each as x, y, radius [m]."""
        found = [
            (*pose[:2], shape.radius)
            for o in self.obstacles
            if o.fixed
            for shape, pose in o.parts()
            if isinstance(shape, ROUND)
        ]
        return np.array(found, dtype=float).reshape(-1, 3)

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """The bounding box of everything: x and y of its lower left and of its upper right corner [m].

        An empty world is 10 m wide.
        """
        points = [self.walls.reshape(-1, 2)]
        for o in self.obstacles:
            if isinstance(o.motion, Walk):
                points.append(np.array(o.motion.waypoints))
            for shape, pose in o.parts():
                if isinstance(shape, ROUND):
                    r = shape.radius
                    points.append(np.array([(pose[0] - r, pose[1] - r), (pose[0] + r, pose[1] + r)]))
                else:
                    points.append(outline_at(shape, pose))
        every = np.vstack(points)
        if not len(every):
            return (-5.0, -5.0, 5.0, 5.0)
        low, high = every.min(axis=0), every.max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    @cached_property
    def closed(self) -> bool:
        """True if the world has an outside: it is traced from a plan, or fixed obstacles surround its first start."""
        if len(self.walls):
            return True
        x, y, _ = self.starts[0]
        seen = raycast(self.segments, self.discs, x, y, 0.0, math.tau / RAYS, RAYS, math.inf, backend="numpy")
        return bool(np.isfinite(seen).all())

    def outside(self, pose: Pose) -> str | None:
        """Describe why a position is outside the world; None if it is inside.

        An open world ends at the distance `FAR` from its contents.

        Raises `WorldError` for a pose that is not finite.
        """
        problem = pose_problem("pose", pose)
        if problem:
            raise WorldError(f"nothing can be placed there: {problem}")
        x0, y0, x1, y1 = self.bounds
        more = 0.0 if self.closed else FAR
        if x0 - more <= pose[0] <= x1 + more and y0 - more <= pose[1] <= y1 + more:
            return None
        extent = f"from ({x0:.2f}, {y0:.2f}) to ({x1:.2f}, {y1:.2f})"
        return f"({pose[0]:.6g}, {pose[1]:.6g}) is outside of the world {self.name!r}, which goes {extent}"

    def blocked(self, pose: Pose, footprint: Footprint, height: float = 0.0) -> str | None:
        """Describe the fixed obstacle or wall that a footprint at `pose` overlaps.

        Return None if it is free. The footprint is corners (n, 2), counter-clockwise, relative to the pose, or the
        radius of a disc around it [m]; `height` is its upper end [m], so that it can pass under obstacles. Touching is
        allowed; obstacles that can move are ignored. Raises `WorldError` for a pose that is not finite.
        """
        problem = pose_problem("pose", pose)
        if problem:
            raise WorldError(f"nothing can be placed there: {problem}")
        return self._fixtures.blocked(pose, footprint, height)

    @cached_property
    def _fixtures(self) -> Fixtures:
        found = Fixtures(self.hard_walls, solid=self.solid)
        for obstacle in self.obstacles:
            if obstacle.fixed and not obstacle.passable:
                found.insert(obstacle.name, obstacle.bottom, obstacle.parts())
        return found

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a copy; the index of fixed obstacles is rebuilt."""
        return {name: value for name, value in vars(self).items() if name != "_fixtures"}

    def free_place(
        self, pose: Pose, footprint: Footprint, height: float = 0.0, taken: Callable[[Pose], object] = lambda _: None
    ) -> Pose | None:
        """Return the nearest position to `pose` that is free for a footprint, with the same heading.

        Return None if none is found. The search covers a metre, in steps of 5 cm, inside the world's bounds, and then
        the world's starts. `taken(pose)` is true, or a description, if an object outside the world, such as a robot, is
        there. Raises `WorldError` for a pose that is not finite.
        """

        def free(place: Pose) -> bool:
            return self.blocked(place, footprint, height) is None and not taken(place)

        if free(pose):
            return pose
        x0, y0, x1, y1 = self.bounds
        steps = np.arange(-20, 21) * 0.05
        across, up = (each.ravel() for each in np.meshgrid(steps, steps))
        away = np.hypot(across, up)
        x, y, theta = pose
        for i in np.argsort(away, kind="stable")[: np.count_nonzero(away <= 1.0)]:
            place = (x + float(across[i]), y + float(up[i]), theta)
            if x0 <= place[0] <= x1 and y0 <= place[1] <= y1 and free(place):
                return place
        return min(filter(free, self.starts), key=lambda start: math.dist(start[:2], (x, y)), default=None)

    def with_obstacles(self, obstacles: Iterable[Obstacle]) -> World:
        """Return the same world with additional obstacles."""
        return replace(self, obstacles=(*self.obstacles, *obstacles))

    def with_just(self, obstacles: Iterable[Obstacle]) -> World:
        """Return the same world with exactly these obstacles, whose names must differ."""
        new = object.__new__(World)
        own = {each.name: vars(self)[each.name] for each in fields(self)}
        vars(new).update(own, obstacles=tuple(obstacles))  # skip the checks, which have already been made
        return new


# ---- validation ----


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _range_problem(field_name: str, value: object, most: float) -> str:
    if is_finite(value) and 0 <= float(value) <= most:  # type: ignore[arg-type]
        return ""
    bound = "on" if math.isinf(most) else f"to {most:g}"
    return f"{field_name} is {value!r}; it must be a finite number from 0 {bound}"
