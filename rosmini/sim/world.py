"""What a robot drives in: walls, obstacles and places to start from, seen from above.

A world is plain data in metres and radians, in the frame `map`: x to the right, y up, angles counter-clockwise (REP
103). Whatever it was made from (Python, a ROS map, later a Gazebo or a Stage file), the engine, the lidar and the
pictures read this one structure.
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
from rosmini.core.geometry.raycast import raycast
from rosmini.core.graph.show import show

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
"""In so many directions from its start a world has to be bounded to have an outside."""

FAR = 10_000.0
"""How far an open world goes on beyond what stands in it [m]."""


@dataclass(frozen=True)
class Obstacle:
    """A thing in a world: fixed, or movable by robots if it has a mass, or moving by itself if it has a motion.

    Raises `WorldError`, which names the obstacle and the field, for a number that is not finite, a size or a mass that
    is not positive, a colour that is none, a top that is not above the bottom, and a polygon that crosses itself or
    whose corners go clockwise.
    """

    name: str
    shape: Shape
    pose: Pose = (0.0, 0.0, 0.0)
    height: float = 0.5
    """How high above the ground its top is [m]; a laser above it does not see it.

    That of a sphere is where its radius takes it.
    """
    colour: Colour = "grey"
    mass: float | None = None
    """[kg]; None: nobody can push it."""
    bottom: float = 0.0
    """How high above the ground it begins [m]: what is lower, a robot or a laser, passes under it."""
    motion: Motion | None = None
    """How it moves by itself; None: it does not."""
    drag: float | None = None
    """Of what can be pushed: its friction on the ground; None: that of the engine, 0.5."""
    restitution: float = 0.0
    """Of what can be pushed: how much of its speed it has after a blow, from 0 to 1.

    Of two such things the product counts.
    """
    passable: bool = False
    """Robots and other things pass through it; lasers and cameras see it all the same."""
    seen_by_lasers: bool = True
    """False: lasers see through it."""

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise WorldError(f"an obstacle has the name {self.name!r}; each needs one, to be spoken of")
        problem = (
            shape_problem(self.shape)
            or pose_problem("pose", self.pose)
            or (
                f"bottom is {self.bottom!r}; it has to be a finite number"
                if not is_finite(self.bottom)
                else ""
            )
        )
        if not problem and isinstance(self.shape, Sphere):
            object.__setattr__(self, "height", self.bottom + 2 * self.shape.radius)
        problem = (
            problem
            or positive_problem("height", self.height)
            or (
                f"its bottom is at {self.bottom!r} and its height is {self.height!r}; the top has to be above the "
                "bottom"
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
            return f"motion is {self.motion!r}; it has to be a Walk or a Door"
        return (
            "it has a mass, so robots push it, and a motion of its own; it can have one of them"
            if self.mass
            else ""
        )

    @property
    def movable(self) -> bool:
        """Tell whether a robot can push it."""
        return self.mass is not None

    @property
    def fixed(self) -> bool:
        """Tell whether it always stays where it is."""
        return self.mass is None and self.motion is None

    def at(self, t: float) -> Pose:
        """Where it is at the time t [s] of its own motion, or its pose if it has none."""
        return self.pose if self.motion is None else self.motion.pose_at(t, self.pose)

    def parts(self) -> list[tuple[Simple, Pose]]:
        """The shapes without parts that it is made of, each with its pose in the world."""
        return list(simple_parts(self.shape, self.pose))

    def outline(self) -> NDArray[np.float64]:
        """The corners (n, 2) in the world; what is round or has several parts has none."""
        return (
            outline_at(self.shape, self.pose) if isinstance(self.shape, (Box, Polygon)) else np.empty((0, 2))
        )


def edges(outline: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sides (n, 4) of a closed outline (n, 2), each as x1, y1, x2, y2."""
    return polygons.sides_of(outline)


@dataclass(frozen=True, eq=False)
class World:
    """A flat world."""

    name: str
    obstacles: tuple[Obstacle, ...] = ()
    walls: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 4)))
    """Thin walls (n, 4), each a segment x1, y1, x2, y2 [m]: what a map is traced to."""
    wall_height: float = 0.5
    starts: tuple[Pose, ...] = ((0.0, 0.0, 0.0),)
    """Where robots are put when nobody says where, in this order."""
    title: str = ""
    """A few words for captions."""
    solid: bool = False
    """The walls are closed outlines, and what is inside of them (by the even-odd rule) is solid, as in a traced map."""
    passable_walls: bool = False
    """Robots pass through the walls; lasers and cameras see them all the same."""

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
            return "walls has to be a table of numbers (n, 4), each row x1, y1, x2, y2"
        if not walls.size:
            walls = walls.reshape(0, 4)
        if walls.ndim != 2 or walls.shape[1] != 4:
            return f"walls has to be a table (n, 4), each row x1, y1, x2, y2, not {walls.shape}"
        wrong = np.flatnonzero(~np.isfinite(walls).all(axis=1))
        if len(wrong):
            return f"walls[{wrong[0]}] is {walls[wrong[0]].tolist()}; its numbers have to be finite"
        walls.flags.writeable = False
        object.__setattr__(self, "walls", walls)
        if not self.solid:
            return ""
        ends, counts = np.unique(walls.reshape(-1, 2), axis=0, return_counts=True)
        if (counts % 2).any():
            x, y = ends[counts % 2 == 1][0]
            return (
                f"its walls are solid but not closed: one ends at ({x:.3f}, {y:.3f}), where no other begins"
            )
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
        """The smallest rectangle around everything: x and y of its lower left and of its upper right corner [m].

        A world with nothing in it is 10 m wide.
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
        """Whether the world has an outside: it is traced from a plan, or fixed things surround its first start."""
        if len(self.walls):
            return True
        x, y, _ = self.starts[0]
        seen = raycast(self.segments, self.discs, x, y, 0.0, math.tau / RAYS, RAYS, math.inf, backend="numpy")
        return bool(np.isfinite(seen).all())

    def outside(self, pose: Pose) -> str | None:
        """Why a place is not in the world, in words that fit into a sentence; None if it is.

        An open world ends `FAR` from all that stands in it.

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
        """What of the fixed things a footprint at `pose` overlaps with, in words that fit into a sentence.

        None if it is free. The footprint is corners (n, 2), counter-clockwise, seen from the pose, or the radius of a
        disc around it [m]; `height` is how high it reaches [m], which matters for what it may pass under. What only
        touches is free, and so is what is movable or moves. Raises `WorldError` for a pose that is not finite.
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
        """Return what a copy is made from; the index of what is fixed is made again."""
        return {name: value for name, value in vars(self).items() if name != "_fixtures"}

    def free_place(
        self,
        pose: Pose,
        footprint: Footprint,
        height: float = 0.0,
        taken: Callable[[Pose], object] = lambda _: None,
    ) -> Pose | None:
        """The nearest place to `pose` that is free for a footprint, with the same heading.

        None if there seems to be none. It is looked for within a metre, in steps of 5 cm, inside the bounds of the
        world; after that among the world's starts. `taken(pose)` is true, or words, where something stands that is no
        part of the world: a robot. Raises `WorldError` for a pose that is not finite.
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
        """The same world with more obstacles in it."""
        return replace(self, obstacles=(*self.obstacles, *obstacles))

    def with_just(self, obstacles: Iterable[Obstacle]) -> World:
        """The same world with these obstacles in it, whose names have to differ, and no others."""
        new = object.__new__(World)
        own = {each.name: vars(self)[each.name] for each in fields(self)}
        vars(new).update(own, obstacles=tuple(obstacles))  # without a check of what has been checked
        return new

    def show(self, **options: Any) -> Any:
        """A picture of the world from above, in metres.

        Options, with what they are unless given:
            robot=None: where the robot is: x [m], y [m], heading [rad], in the world's frame; None: there is none
            model=None: which robot; None: a TurtleBot3 Burger
            scan=None: what its laser sees: a `sensor_msgs/LaserScan`, or ranges [m], beam i at 2 pi i / beams
            scan_from=None: where the robot was then, or at each beam (beams, 3); None: where it is
            trail=None: where the robot was, (n, 2) or (n, 3): a solid line
            odom=None: where its odometry believes that it was, likewise: a dashed line
            others=(): more robots, each an `Other`: they are drawn in other colours, with their names
            name='': of the robot, where there are others
            title=None: a caption under the picture, and the first words of its text form
            size=(660.0, 540.0): the largest width and height [CSS px]
        """
        return show("world", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The world in three dimensions.

        Options, with what they are unless given:
            distance=None: of the camera from what it looks at [m]; None: what shows it well
            azimuth=None: from where it looks [deg], 0: from the side of x, 90: of y; None: what shows it well
            elevation=None: how high from [deg]; None: what shows it well
            title=None: a caption under the picture, and the first words of its text form
            height=420: of the viewer [CSS px]
        """
        return show("world_3d", self, **options)


# ---- what is possible ----


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _range_problem(field_name: str, value: object, most: float) -> str:
    if is_finite(value) and 0 <= float(value) <= most:  # type: ignore[arg-type]
        return ""
    bound = "on" if math.isinf(most) else f"to {most:g}"
    return f"{field_name} is {value!r}; it has to be a finite number from 0 {bound}"
