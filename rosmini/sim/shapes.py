"""Shapes of objects, seen from above: boxes, cylinders, spheres, polygons, and compounds of them.

Lengths in metres, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError, nearest
from rosmini.core.geometry import polygons
from rosmini.core.geometry.poses import Pose, compose
from rosmini.core.geometry.products import matrix_product

Colour = str
"""One of `COLOURS`, or any "#rrggbb"."""

COLOURS = ("wall", "grey", "blue", "orange", "green", "vermilion", "purple", "sky")
"""The named colours of the house style, which have a light and a dark form."""


class WorldError(RosminiError, ValueError):
    """A world, or a position in it, is invalid; the message names the obstacle, wall or field."""


@dataclass(frozen=True)
class Box:
    """A rectangle around its pose, `length` along x and `width` along y [m]."""

    length: float
    width: float

    @property
    def outline(self) -> NDArray[np.float64]:
        """The corners (4, 2), counter-clockwise, in the shape's frame."""
        x, y = self.length / 2, self.width / 2
        return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])


@dataclass(frozen=True)
class Cylinder:
    """A disc around its pose [m]."""

    radius: float


@dataclass(frozen=True)
class Sphere:
    """A ball on the `bottom`, with twice its radius [m] as height: a laser sees its circle at the laser's height."""

    radius: float

    def cut(self, height: float) -> float:
        """Return the radius of the circle at this height [m] above its lowest point; 0 above and below the ball."""
        up = height - self.radius
        return math.sqrt(max(0.0, self.radius * self.radius - up * up))


@dataclass(frozen=True)
class Polygon:
    """A simple polygon, its corners counter-clockwise in the shape's frame [m]."""

    corners: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "corners", tuple(tuple(corner) for corner in self.corners))
        except TypeError as error:
            raise WorldError(f"the corners of a polygon are pairs of x and y, not {self.corners!r}") from error

    @property
    def outline(self) -> NDArray[np.float64]:
        """The corners (n, 2), counter-clockwise, in the shape's frame."""
        return np.array(self.corners, dtype=float)


@dataclass(frozen=True)
class Compound:
    """One object made of several shapes, each at a pose in the frame of the whole; they may overlap."""

    parts: tuple[tuple[Box | Cylinder | Sphere | Polygon | Compound, Pose], ...]

    def __post_init__(self) -> None:
        try:
            parts = tuple((shape, (x, y, theta)) for shape, (x, y, theta) in self.parts)
        except (TypeError, ValueError) as error:
            raise WorldError(
                f"the parts of a compound are pairs of a shape and its pose x, y, heading, not {self.parts!r}"
            ) from error
        object.__setattr__(self, "parts", parts)


@dataclass(frozen=True)
class Part:
    """A solid part of an object: an upright shape from `bottom` to `top`.

    Raises `WorldError`, which contains the name of the invalid number.
    """

    shape: Shape
    pose: Pose
    """In the frame of the whole, or in the world."""
    bottom: float
    """Height of its lower end above the ground [m]."""
    top: float
    """Height of its upper end above the ground [m]."""
    colour: Colour = "grey"
    name: str = ""
    """The name of its owner: a robot or an obstacle."""

    def __post_init__(self) -> None:
        problem = shape_problem(self.shape) or pose_problem("pose", self.pose) or colour_problem(self.colour)
        if not problem and not self.bottom < self.top:
            place = f"its bottom is at {self.bottom!r} and its top at {self.top!r}"
            problem = f"{place}; the top must be above the bottom"
        if problem:
            raise WorldError(f"a part of {self.name or 'a model'} is not possible: {problem}")


Simple = Box | Cylinder | Sphere | Polygon
"""The shapes without parts."""

Shape = Simple | Compound

ROUND = (Cylinder, Sphere)
"""The shapes that are discs when seen from above."""


def simple_parts(shape: Shape, pose: Pose = (0.0, 0.0, 0.0)) -> Iterator[tuple[Simple, Pose]]:
    """Yield the simple shapes of a shape at `pose`, each with its pose in the frame of `pose`."""
    if isinstance(shape, Compound):
        for part, place in shape.parts:
            yield from simple_parts(part, compose(pose, place))
    else:
        yield shape, pose


def outline_at(shape: Box | Polygon, pose: Pose) -> NDArray[np.float64]:
    """Return the corners (n, 2), counter-clockwise, of a box or a polygon at `pose`."""
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    turned = matrix_product(shape.outline, [[c, s], [-s, c]])
    turned += (x, y)
    return turned


def reach_of(shape: Shape) -> float:
    """Return the distance of a shape's farthest point from its origin [m]."""
    reach = 0.0
    for part, pose in simple_parts(shape):
        if isinstance(part, ROUND):
            reach = max(reach, math.hypot(pose[0], pose[1]) + part.radius)
        else:
            reach = max(reach, float(np.hypot(*outline_at(part, pose).T).max()))
    return reach


# ---- validation: each function returns a description of the problem, or "" ----


def is_finite(value: object) -> bool:
    """Return True if the value is a finite number."""
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool) and math.isfinite(value)


def positive_problem(field_name: str, value: object) -> str:
    """Describe why a value is not a finite number above 0."""
    if not is_finite(value):
        return f"{field_name} is {value!r}; it must be a finite number"
    return "" if float(value) > 0 else f"{field_name} is {value!r}; it must be more than 0"  # type: ignore[arg-type]


def pose_problem(field_name: str, pose: object) -> str:
    """Describe why a value is not a pose."""
    if isinstance(pose, (tuple, list, np.ndarray)) and len(pose) == 3 and all(map(is_finite, pose)):
        return ""
    return f"{field_name} is {pose!r}; it must be finite x, y and heading"


def colour_problem(colour: object) -> str:
    """Describe why a value is not a colour."""
    if colour in COLOURS:
        return ""
    text = str(colour)
    if text.startswith("#"):
        if len(text) == 7 and all(digit in "0123456789abcdefABCDEF" for digit in text[1:]):
            return ""
        return f"colour is {colour!r}; a colour by its parts is # and six digits from 0 to f, as '#c05020'"
    hint = nearest(text, COLOURS)
    return f"colour is {colour!r}; it must be one of {', '.join(COLOURS)}, or '#rrggbb'{'; ' + hint if hint else ''}"


def shape_problem(shape: object) -> str:
    """Describe why a value is not a valid shape."""
    if not isinstance(shape, Shape):
        return f"shape is {shape!r}; it must be a Box, a Cylinder, a Sphere, a Polygon or a Compound"
    try:
        return _size_problem(shape)
    except TypeError:  # an unhashable value is not a number
        return f"shape is {shape!r}; its sizes must be finite numbers"


@lru_cache(maxsize=256)
def _size_problem(shape: Shape) -> str:
    if isinstance(shape, Box):
        return positive_problem("shape.length", shape.length) or positive_problem("shape.width", shape.width)
    if isinstance(shape, ROUND):
        return positive_problem("shape.radius", shape.radius)
    if isinstance(shape, Compound):
        if not shape.parts:
            return "shape.parts is empty; a compound has one part at least"
        for i, (part, pose) in enumerate(shape.parts):
            problem = shape_problem(part) or pose_problem("pose", pose)
            if problem:
                return f"shape.parts[{i}]: {problem}"
        return ""
    for i, corner in enumerate(shape.corners):
        if len(corner) != 2 or not all(map(is_finite, corner)):
            return f"shape.corners[{i}] is {corner!r}; it must be finite x and y"
    if len(shape.corners) < 3:
        return f"shape.corners are {len(shape.corners)}; a polygon has 3 or more"
    crossing = polygons.crossing_sides(shape.outline)
    if crossing is not None:
        return f"shape.corners cross themselves: the sides from corner {crossing[0]} and from corner {crossing[1]} meet"
    if polygons.area(shape.outline) < 0:
        return "shape.corners go clockwise; turn their order round"
    return ""
