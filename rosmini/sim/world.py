"""What a robot drives in: walls, obstacles and places to start from, seen from above.

A world is plain data in metres and radians, in the frame `map`: x to the right, y up, angles counter-clockwise (REP 103).
Whatever it was made from (Python, a ROS map, later a Gazebo or a Stage file), the engine, the lidar and the pictures read this one structure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.errors import RosminiError
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

    @property
    def outline(self) -> NDArray[np.float64]:
        """The corners (n, 2), counter-clockwise, in the shape's own frame."""
        return np.array(self.corners, dtype=float)


Shape = Box | Cylinder | Polygon


@dataclass(frozen=True)
class Obstacle:
    """A thing in a world: it stands where it is, or a robot can push it if it has a mass."""

    name: str
    shape: Shape
    pose: Pose = (0.0, 0.0, 0.0)
    height: float = 0.5
    """How high it reaches from the ground [m]; a laser above it does not see it."""
    colour: Colour = "grey"
    mass: float | None = None
    """[kg]; None: fixed to the ground."""

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


def edges(outline: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sides (n, 4) of a closed outline (n, 2), each as x1, y1, x2, y2."""
    return np.hstack([outline, np.roll(outline, -1, axis=0)])


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

    def __repr__(self) -> str:
        return f"<World {self.name}: {len(self.walls)} walls, {len(self.obstacles)} obstacles>"

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

    def with_obstacles(self, obstacles: Iterable[Obstacle]) -> World:
        """The same world with more obstacles in it."""
        return replace(self, obstacles=(*self.obstacles, *obstacles))

    def show(self, **options: Any) -> Any:
        """A picture of the world; the options are those of `rosmini.viz.world_picture`."""
        return show("world", self, **options)
