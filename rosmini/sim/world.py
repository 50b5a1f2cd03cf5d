"""What a robot drives in: walls, obstacles and places to start from, seen from above.

A world is plain data in metres and radians, in the frame `map`: x to the right, y up, angles counter-clockwise (REP 103).
Whatever it was made from (Python, a ROS map, later a Gazebo or a Stage file), the engine, the lidar and the pictures read this one structure.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError, nearest
from rosmini.geometry import polygons
from rosmini.geometry.poses import transform_points
from rosmini.graph.show import show

Pose = tuple[float, float, float]
"""x [m], y [m] and heading [rad]."""

Colour = Literal["wall", "grey", "blue", "orange", "green", "vermilion", "purple", "sky"]


class WorldError(RosminiError, ValueError):
    """A world, or a place in it, is not possible; the message names the obstacle, wall or field at fault."""


@dataclass(frozen=True)
class Box:
    """A rectangle around its pose, `length` along its x and `width` along its y [m]."""

    length: float
    width: float

    @property
    def outline(self) -> NDArray[np.float64]:
        """The corners (4, 2), counter-clockwise, in the shape's own frame."""
        x, y = self.length / 2, self.width / 2
        return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])


@dataclass(frozen=True)
class Cylinder:
    """A disc around its pose [m]."""

    radius: float


@dataclass(frozen=True)
class Polygon:
    """A simple polygon, its corners counter-clockwise in the shape's own frame [m]."""

    corners: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "corners", tuple(tuple(corner) for corner in self.corners))
        except TypeError as error:
            raise WorldError(
                f"the corners of a polygon are pairs of x and y, not {self.corners!r}"
            ) from error

    @property
    def outline(self) -> NDArray[np.float64]:
        """The corners (n, 2), counter-clockwise, in the shape's own frame."""
        return np.array(self.corners, dtype=float)


Shape = Box | Cylinder | Polygon


@dataclass(frozen=True)
class Obstacle:
    """A thing in a world: it stands where it is, or a robot can push it if it has a mass.

    Raises `WorldError`, which names the obstacle and the field, for a number that is not finite, a size or a mass that is not positive, a colour
    that is none, and a polygon that crosses itself or whose corners go clockwise.
    """

    name: str
    shape: Shape
    pose: Pose = (0.0, 0.0, 0.0)
    height: float = 0.5
    """How high it reaches from the ground [m]; a laser above it does not see it."""
    colour: Colour = "grey"
    mass: float | None = None
    """[kg]; None: fixed to the ground."""

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise WorldError(f"an obstacle has the name {self.name!r}; each needs one, to be spoken of")
        problem = (
            _shape_problem(self.shape)
            or _pose_problem("pose", self.pose)
            or _positive("height", self.height)
            or (_positive("mass", self.mass) if self.mass is not None else "")
            or _colour_problem(self.colour)
        )
        if problem:
            raise WorldError(f"the obstacle {self.name!r} is not possible: {problem}")

    @property
    def movable(self) -> bool:
        """Tell whether a robot can push it."""
        return self.mass is not None

    def outline(self) -> NDArray[np.float64]:
        """The corners (n, 2) in the world; a cylinder has none."""
        if isinstance(self.shape, Cylinder):
            return np.empty((0, 2))
        x, y, theta = self.pose
        c, s = math.cos(theta), math.sin(theta)
        turned: NDArray[np.float64] = self.shape.outline @ np.array([[c, s], [-s, c]]) + (x, y)
        return turned


Footprint = Sequence[tuple[float, float]] | NDArray[np.float64] | float
"""Corners (n, 2), counter-clockwise, seen from a pose, or the radius of a disc around it [m]."""


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

    def __post_init__(self) -> None:
        problem = (
            ("it needs a name" if not isinstance(self.name, str) or not self.name.strip() else "")
            or self._obstacles_problem()
            or _positive("wall_height", self.wall_height)
            or self._walls_problem()
            or ("starts: it needs one at least" if not self.starts else "")
            or "".join(_pose_problem(f"starts[{i}]", pose) for i, pose in enumerate(self.starts))
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
        ends, counts = np.unique(walls.reshape(-1, 2), axis=0, return_counts=True)
        if self.solid and (counts % 2).any():
            x, y = ends[counts % 2 == 1][0]
            return (
                f"its walls are solid but not closed: one ends at ({x:.3f}, {y:.3f}), where no other begins"
            )
        return ""

    def __repr__(self) -> str:
        return f"<World {self.name}: {_count(len(self.walls), 'wall')}, {_count(len(self.obstacles), 'obstacle')}>"

    @cached_property
    def segments(self) -> NDArray[np.float64]:
        """All fixed straight sides (n, 4): walls, and the sides of fixed boxes and polygons."""
        sides = [
            edges(o.outline()) for o in self.obstacles if not o.movable and not isinstance(o.shape, Cylinder)
        ]
        return np.vstack([self.walls.reshape(-1, 4), *sides])

    @cached_property
    def discs(self) -> NDArray[np.float64]:
        """All fixed cylinders (n, 3), each as x, y, radius [m]."""
        found = [
            (*o.pose[:2], o.shape.radius)
            for o in self.obstacles
            if isinstance(o.shape, Cylinder) and not o.movable
        ]
        return np.array(found, dtype=float).reshape(-1, 3)

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """The smallest rectangle around everything: x and y of its lower left and of its upper right corner [m].

        A world with nothing in it is 10 m wide.
        """
        points = [self.walls.reshape(-1, 2)]
        for o in self.obstacles:
            if isinstance(o.shape, Cylinder):
                r = o.shape.radius
                points.append(np.array([(o.pose[0] - r, o.pose[1] - r), (o.pose[0] + r, o.pose[1] + r)]))
            else:
                points.append(o.outline())
        every = np.vstack(points)
        if not len(every):
            return (-5.0, -5.0, 5.0, 5.0)
        low, high = every.min(axis=0), every.max(axis=0)
        return (float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    def blocked(self, pose: Pose, footprint: Footprint) -> str | None:
        """What of the fixed things a footprint at `pose` overlaps with, in words that fit into a sentence; None if it is free.

        The footprint is corners (n, 2), counter-clockwise, seen from the pose, or the radius of a disc around it [m]. What only touches is free, and
        so is what is movable. Raises `WorldError` for a pose that is not finite.
        """
        problem = _pose_problem("pose", pose)
        if problem:
            raise WorldError(f"nothing can be placed there: {problem}")
        place = _Place(pose, footprint)
        for obstacle in self.obstacles:
            if not obstacle.movable and place.overlaps(obstacle):
                return f"the obstacle {obstacle.name!r}"
        return place.wall(self.walls, solid=self.solid)

    def free_place(self, pose: Pose, footprint: Footprint) -> Pose | None:
        """The nearest place to `pose` that is free for a footprint, with the same heading; None if there seems to be none.

        It is looked for within a metre, in steps of 5 cm, inside the bounds of the world; after that among the world's starts. Raises
        `WorldError` for a pose that is not finite.
        """
        if self.blocked(pose, footprint) is None:
            return pose
        x0, y0, x1, y1 = self.bounds
        steps = np.arange(-20, 21) * 0.05
        across, up = (each.ravel() for each in np.meshgrid(steps, steps))
        away = np.hypot(across, up)
        x, y, theta = pose
        for i in np.argsort(away, kind="stable")[: np.count_nonzero(away <= 1.0)]:
            place = (x + float(across[i]), y + float(up[i]), theta)
            if x0 <= place[0] <= x1 and y0 <= place[1] <= y1 and self.blocked(place, footprint) is None:
                return place
        free = [start for start in self.starts if self.blocked(start, footprint) is None]
        return min(free, key=lambda start: math.dist(start[:2], (x, y)), default=None)

    def with_obstacles(self, obstacles: Iterable[Obstacle]) -> World:
        """The same world with more obstacles in it."""
        return replace(self, obstacles=(*self.obstacles, *obstacles))

    def show(self, **options: Any) -> Any:
        """A picture of the world; the options are those of `rosmini.viz.world_picture`."""
        return show("world", self, **options)

    def show3d(self, **options: Any) -> Any:
        """The world in three dimensions; the options are those of `rosmini.viz.meshcat.world_3d`."""
        return show("world_3d", self, **options)


class _Place:
    """A footprint at a pose."""

    def __init__(self, pose: Pose, footprint: Footprint) -> None:
        self.centre = np.array([pose[:2]])
        if isinstance(footprint, (int, float)):
            self.radius = float(footprint)
            self.outline = None
        else:
            self.radius = 0.0
            self.outline = transform_points(pose, np.asarray(footprint, dtype=np.float64))

    def overlaps(self, obstacle: Obstacle) -> bool:
        x, y = obstacle.pose[:2]
        if isinstance(obstacle.shape, Cylinder):
            if self.outline is not None:
                return polygons.overlaps_disc(self.outline, x, y, obstacle.shape.radius)
            gap = math.dist(self.centre[0], (x, y)) - self.radius - obstacle.shape.radius
            return gap < -polygons.TOUCH
        if self.outline is not None:
            return polygons.overlap(self.outline, obstacle.outline())
        return polygons.overlaps_disc(obstacle.outline(), self.centre[0, 0], self.centre[0, 1], self.radius)

    def wall(self, walls: NDArray[np.float64], *, solid: bool) -> str | None:
        """Which of the walls it overlaps with."""
        if not len(walls):
            return None
        if self.outline is None:
            hit = polygons.each_distance(self.centre, walls)[0] < self.radius - polygons.TOUCH
        else:
            x, y = walls[:, ::2], walls[:, 1::2]
            low, high = self.outline.min(axis=0), self.outline.max(axis=0)
            hit = (
                (x.max(axis=1) >= low[0])
                & (x.min(axis=1) <= high[0])
                & (y.max(axis=1) >= low[1])
                & (y.min(axis=1) <= high[1])
            )
            hit[hit] = polygons.enters(walls[hit], self.outline)
        if hit.any():
            x1, y1, x2, y2 = walls[np.flatnonzero(hit)[0]]
            return f"the wall from ({x1:.2f}, {y1:.2f}) to ({x2:.2f}, {y2:.2f})"
        if solid and polygons.inside(self.centre if self.outline is None else self.outline[:1], walls)[0]:
            return "the inside of a wall"
        return None


# ---- what is possible ----


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _is_finite(value: object) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool) and math.isfinite(value)


def _positive(field_name: str, value: object) -> str:
    if not _is_finite(value):
        return f"{field_name} is {value!r}; it has to be a finite number"
    return "" if float(value) > 0 else f"{field_name} is {value!r}; it has to be more than 0"  # type: ignore[arg-type]


def _pose_problem(field_name: str, pose: object) -> str:
    if isinstance(pose, (tuple, list, np.ndarray)) and len(pose) == 3 and all(map(_is_finite, pose)):
        return ""
    return f"{field_name} is {pose!r}; it has to be finite x, y and heading"


def _colour_problem(colour: object) -> str:
    if colour in get_args(Colour):
        return ""
    hint = nearest(str(colour), get_args(Colour))
    return f"colour is {colour!r}; it has to be one of {', '.join(get_args(Colour))}{'; ' + hint if hint else ''}"


def _shape_problem(shape: object) -> str:
    if not isinstance(shape, Shape):
        return f"shape is {shape!r}; it has to be a Box, a Cylinder or a Polygon"
    try:
        return _size_problem(shape)
    except TypeError:  # what has no hash is no number
        return f"shape is {shape!r}; its sizes have to be finite numbers"


@lru_cache(maxsize=256)
def _size_problem(shape: Shape) -> str:
    if isinstance(shape, Box):
        return _positive("shape.length", shape.length) or _positive("shape.width", shape.width)
    if isinstance(shape, Cylinder):
        return _positive("shape.radius", shape.radius)
    for i, corner in enumerate(shape.corners):
        if len(corner) != 2 or not all(map(_is_finite, corner)):
            return f"shape.corners[{i}] is {corner!r}; it has to be finite x and y"
    if len(shape.corners) < 3:
        return f"shape.corners are {len(shape.corners)}; a polygon has 3 or more"
    crossing = polygons.crossing_sides(shape.outline)
    if crossing is not None:
        return f"shape.corners cross themselves: the sides from corner {crossing[0]} and from corner {crossing[1]} meet"
    if polygons.area(shape.outline) < 0:
        return "shape.corners go clockwise; turn their order round"
    return ""
