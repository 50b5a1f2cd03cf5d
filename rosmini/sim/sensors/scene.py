"""The objects of a world that a camera can see, as arrays: flat faces, cylinders and balls, each with its colour.

Upright sides, tops and bottoms are faces of four corners; a polygon's top is divided into trapezia, and so is the top
of solid walls.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import compose
from rosmini.core.geometry.products import norms
from rosmini.sim.shapes import Cylinder, Part, Sphere, outline_at, simple_parts

if TYPE_CHECKING:
    from rosmini.sim.world import Obstacle

Floats = NDArray[np.float64]
Rgb = tuple[float, float, float]

PAINT = {
    "wall": "#d6d9dc", "grey": "#98a3ad", "blue": "#0072b2", "orange": "#d97f00", "green": "#00865f",
    "vermilion": "#d55e00", "purple": "#b85c93", "sky": "#3a9bd9",
}  # fmt: skip
"""The colours of `rosmini.sim.shapes` as a camera sees them in full light."""


def rgb(colour: str) -> Rgb:
    """Return red, green and blue, each 0 to 1, of a named colour or of "#rrggbb"."""
    digits = PAINT.get(colour, colour)
    return (int(digits[1:3], 16) / 255, int(digits[3:5], 16) / 255, int(digits[5:7], 16) / 255)


def _none(*shape: int) -> Floats:
    return np.empty((0, *shape))


@dataclass(frozen=True, eq=False)
class Scene:
    """Visible objects in the frame of the world [m]. `a + b` contains the objects of both."""

    faces: Floats = field(default_factory=lambda: _none(4, 3))
    """(n, 4, 3): corners, counter-clockwise seen from outside; a triangle repeats its last corner."""
    paints: Floats = field(default_factory=lambda: _none(3))
    """(n, 3): the faces' colours, 0 to 1."""
    normals: Floats = field(default_factory=lambda: _none(3))
    """(n, 3): the faces' outward unit normals."""
    thin: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=bool))
    """(n,): True for faces that are visible from behind too, as walls without thickness are."""
    rods: Floats = field(default_factory=lambda: _none(5))
    """(m, 5): upright cylinders, each x, y, radius, bottom and top."""
    rod_paints: Floats = field(default_factory=lambda: _none(3))
    balls: Floats = field(default_factory=lambda: _none(4))
    """(k, 4): each x, y, z of its centre, and its radius."""
    ball_paints: Floats = field(default_factory=lambda: _none(3))

    def __add__(self, other: Scene) -> Scene:
        return Scene(
            *(np.concatenate([getattr(self, name), getattr(other, name)]) for name in self.__dataclass_fields__)
        )

    @classmethod
    def of(cls, parts: Iterable[Part]) -> Scene:
        """Return solid parts as seen from outside."""
        quads, paints, thin, rods, rod_paints, balls, ball_paints = _lists()
        for part in parts:
            paint = rgb(part.colour)
            for shape, (x, y, theta) in simple_parts(part.shape, part.pose):
                if isinstance(shape, Cylinder):
                    rods.append((x, y, shape.radius, part.bottom, part.top))
                    rod_paints.append(paint)
                elif isinstance(shape, Sphere):
                    balls.append((x, y, part.bottom + shape.radius, shape.radius))
                    ball_paints.append(paint)
                else:
                    outline = outline_at(shape, (x, y, theta))
                    corners = _prism(outline, part.bottom, part.top)
                    quads.append(corners)
                    paints += [paint] * len(corners)
                    thin += [False] * len(corners)
        faces = np.concatenate([_none(4, 3), *quads])
        return cls(
            faces,
            _table(paints, 3),
            _normals(faces),
            np.array(thin, dtype=bool),
            _table(rods, 5),
            _table(rod_paints, 3),
            _table(balls, 4),
            _table(ball_paints, 3),
        )

    @classmethod
    def walls(cls, segments: Floats, height: float, *, solid: bool = False, colour: str = "wall") -> Scene:
        """Return walls from the ground up on segments (n, 4); if `solid`, with a top on the areas they enclose."""
        (x1, y1, x2, y2), low = np.asarray(segments, dtype=float).reshape(-1, 4).T, np.zeros(len(segments))
        high = low + height
        sides = np.stack(
            [np.column_stack(each) for each in ((x1, y1, low), (x2, y2, low), (x2, y2, high), (x1, y1, high))], axis=1
        )  # fmt: skip
        sides = sides[np.hypot(x2 - x1, y2 - y1) > 0]
        top = trapezia(segments, height) if solid else _none(4, 3)
        faces = np.concatenate([sides, top])
        return cls(
            faces,
            np.tile(rgb(colour), (len(faces), 1)),
            _normals(faces),
            np.repeat([True, False], [len(sides), len(top)]),
        )


def parts_of(obstacles: Iterable[Obstacle]) -> list[Part]:
    """Return obstacles as parts in the world."""
    return [Part(o.shape, o.pose, o.bottom, o.height, o.colour, o.name) for o in obstacles]


def placed(parts: Iterable[Part], pose: tuple[float, float, float]) -> list[Part]:
    """Transform parts from a frame, such as that of a `RobotModel`, with that frame at `pose` in the world."""
    return [Part(p.shape, compose(pose, p.pose), p.bottom, p.top, p.colour, p.name) for p in parts]


def trapezia(segments: Floats, height: float) -> Floats:
    """Return level faces (n, 4, 3) at `height` that fill the closed outlines of segments (m, 4) by the even-odd rule.

    The plane is cut into strips between the y coordinates of neighbouring corners; in a strip, each pair of consecutive
    sides bounds a trapezium.
    """
    sides = np.asarray(segments, dtype=float).reshape(-1, 4)
    sides = sides[sides[:, 1] != sides[:, 3]]
    x1, y1, x2, y2 = np.where((sides[:, 1] > sides[:, 3])[:, None], sides[:, [2, 3, 0, 1]], sides).T
    cuts = np.unique(np.concatenate([y1, y2]))
    found = []
    for low, high in itertools.pairwise(cuts):
        within = (y1 <= low) & (y2 >= high)
        rise = (x2[within] - x1[within]) / (y2[within] - y1[within])
        south, north = (x1[within] + rise * (y - y1[within]) for y in (low, high))
        order = np.argsort(south + north, kind="stable")
        a, b, c, d = south[order[0::2]], south[order[1::2]], north[order[1::2]], north[order[0::2]]
        found += [((a[i], low), (b[i], low), (c[i], high), (d[i], high)) for i in range(min(len(a), len(b)))]
    flat = np.array(found, dtype=float).reshape(-1, 4, 2)
    return np.concatenate([flat, np.full((len(flat), 4, 1), height)], axis=2)


def _prism(outline: Floats, bottom: float, top: float) -> Floats:
    """Return the sides, the top and the bottom of an upright prism, as faces (n, 4, 3)."""
    ends = np.roll(outline, -1, axis=0)
    low, high = np.full(len(outline), bottom), np.full(len(outline), top)
    corners = ((outline, low), (ends, low), (ends, high), (outline, high))
    sides = np.stack([np.column_stack(each) for each in corners], axis=1)
    lid = _lid(outline, top)
    if bottom <= 0:  # on the ground, so its bottom is invisible
        return np.concatenate([sides, lid])
    return np.concatenate([sides, lid, _lid(outline, bottom)[:, ::-1]])


def _lid(outline: Floats, height: float) -> Floats:
    """Return a polygon's area at one height, as faces counter-clockwise seen from above."""
    if len(outline) == 4:
        around = np.roll(outline, -1, axis=0) - outline
        onward = np.roll(around, -1, axis=0)
        if (around[:, 0] * onward[:, 1] - around[:, 1] * onward[:, 0] > 0).all():
            return np.column_stack([outline, np.full(4, height)])[None]
    return trapezia(np.hstack([outline, np.roll(outline, -1, axis=0)]), height)


def _normals(faces: Floats) -> Floats:
    """Return the outward unit normals (n, 3) of faces (n, 4, 3)."""
    across = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    length = norms(across)[:, None]
    unit: Floats = across / np.where(length > 0, length, 1.0)
    return unit


def _lists() -> tuple[list, ...]:  # type: ignore[type-arg]
    return tuple([] for _ in range(7))


def _table(rows: list[tuple[float, ...]], width: int) -> Floats:
    return np.array(rows, dtype=float).reshape(-1, width)
