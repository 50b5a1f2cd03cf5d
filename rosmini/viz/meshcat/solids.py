"""Solid shapes that both the viewer and the drawing understand: prisms, rods and balls, in metres.

A part has one colour and stands in the frame of its node (`robot/wheel_left`). What is round is round in the viewer and
has corners in the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rosmini.sim.urdf.meshes import Surface
from rosmini.viz.rounding import snap

Floats = NDArray[np.float64]
Outline = Floats
"""Corners (n, 2) of a simple polygon, counter-clockwise seen from above."""
Face = Floats
"""Corners (n, 3) of a flat polygon, counter-clockwise seen from outside."""

RESOLUTION = 1e-5
"""To what coordinates are rounded [m], so that they are the same on every machine."""


def rounded(values: Floats) -> Floats:
    """`values` to a hundredth of a millimetre, with no negative zero."""
    return snap(values, RESOLUTION)


@dataclass(frozen=True)
class Prism:
    """A polygon from `bottom` to `top`; seen from below it is open."""

    outline: Outline
    bottom: float
    top: float

    def faces(self) -> Iterator[Face]:
        """The top, then the sides."""
        yield _at(self.outline, self.top)
        low, high = _at(self.outline, self.bottom), _at(self.outline, self.top)
        for i in range(len(self.outline)):
            j = (i + 1) % len(self.outline)
            yield np.array([low[i], low[j], high[j], high[i]])

    def triangles(self) -> Iterator[tuple[Face, NDArray[np.int64]]]:
        """The faces, each with its triangles (m, 3) as places among its corners."""
        top, *sides = self.faces()
        yield top, triangulate(self.outline)
        for side in sides:
            yield side, np.array([(0, 1, 2), (0, 2, 3)])


@dataclass(frozen=True)
class Facets:
    """Convex polygons anywhere."""

    polygons: tuple[Face, ...]

    def faces(self) -> Iterator[Face]:
        """The polygons."""
        yield from self.polygons

    def triangles(self) -> Iterator[tuple[Face, NDArray[np.int64]]]:
        """Each polygon as a fan around its first corner."""
        for face in self.polygons:
            yield face, np.array([(0, i, i + 1) for i in range(1, len(face) - 1)])


@dataclass(frozen=True)
class Rod:
    """A cylinder around its centre; its axis is z, or y from right to left."""

    centre: tuple[float, float, float]
    radius: float
    length: float
    axis: Literal["y", "z"] = "z"

    def faces(self) -> Iterator[Face]:
        """The two ends, then the sides: the thinner, the fewer."""
        corners = next(n for n, below in ((6, 0.006), (14, 0.05), (18, math.inf)) if self.radius < below)
        circle = regular(corners, 1.0) * self.radius
        low, high = _at(circle, -self.length / 2), _at(circle, self.length / 2)
        for face in (
            high,
            low[::-1],
            *(
                np.array([low[i], low[j], high[j], high[i]])
                for i, j in ((i, (i + 1) % corners) for i in range(corners))
            ),
        ):
            # A quarter turn around x takes z to -y: mirror it, so that the axis points to the left.
            turned = face if self.axis == "z" else np.column_stack([face[:, 0], face[:, 2], -face[:, 1]])
            yield turned + self.centre


@dataclass(frozen=True)
class Ball:
    """A sphere."""

    centre: tuple[float, float, float]
    radius: float

    def faces(self) -> Iterator[Face]:
        """Quadrilaterals between circles of latitude."""
        corners = 10
        heights = np.sin(np.linspace(-math.pi / 2, math.pi / 2, corners // 2 + 1))
        rings = [_at(regular(corners, math.sqrt(max(0.0, 1 - h * h))), float(h)) for h in heights]
        for low, high in pairwise(rings):
            for i in range(corners):
                j = (i + 1) % corners
                yield np.array([low[i], low[j], high[j], high[i]]) * self.radius + self.centre


Solid = Prism | Facets | Rod | Ball


@dataclass(frozen=True)
class Part:
    """Solids of one colour in the frame of one node."""

    node: str
    name: str
    colour: str
    """`#rrggbb`"""
    solids: tuple[Solid, ...]
    shine: float = 0.0
    """How bright the lights are mirrored, 0 to 1."""
    fine: bool = False
    """Left out of the drawing."""


@dataclass(frozen=True)
class LinkPart:
    """A surface of one colour, read from a mesh, in the frame of its node."""

    node: str
    name: str
    colour: str
    """`#rrggbb`"""
    surface: Surface


def box(x: float, y: float, z: float, length: float, width: float, height: float) -> Prism:
    """A box around (x, y) that stands on z."""
    a, b = length / 2, width / 2
    return Prism(np.array([(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]), z, z + height)


def plate(x: float, y: float, length: float, width: float, radius: float, corners: int = 5) -> Outline:
    """The outline of a rectangle around (x, y) with round corners."""
    points = []
    for quarter, (a, b) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        for step in range(corners):
            angle = (quarter + step / (corners - 1)) * math.pi / 2
            points.append(
                (
                    x + a * (length / 2 - radius) + radius * math.cos(angle),
                    y + b * (width / 2 - radius) + radius * math.sin(angle),
                )
            )
    return np.array(points)


def regular(corners: int, radius: float) -> Outline:
    """A regular polygon around the origin."""
    angles = np.arange(corners) * (2 * math.pi / corners)
    return np.column_stack([np.cos(angles), np.sin(angles)]) * radius


def mesh(flat: Iterable[Prism | Facets]) -> tuple[Floats, NDArray[np.int64]]:
    """Vertices (n, 3) and triangles (m, 3) of all of them. Faces share no vertices, so that edges are sharp."""
    vertices, triangles, count = [], [], 0
    for solid in flat:
        for face, among in solid.triangles():
            vertices.append(face)
            triangles.append(among + count)
            count += len(face)
    return rounded(np.vstack(vertices)), np.vstack(triangles)


def triangulate(outline: Outline) -> NDArray[np.int64]:
    """The triangles (n - 2, 3) of a simple polygon (n, 2), by cutting ears; all counter-clockwise as the polygon is."""
    left = list(range(len(outline)))
    triangles = []
    while len(left) > 3:
        at = next((i for i in range(len(left)) if _is_ear(outline, left, i)), 0)
        triangles.append((left[at - 1], left[at], left[(at + 1) % len(left)]))
        del left[at]
    return np.array([*triangles, left])


def _is_ear(outline: Outline, left: list[int], at: int) -> bool:
    a, b, c = outline[left[at - 1]], outline[left[at]], outline[left[(at + 1) % len(left)]]
    if _side(a, b, c) <= 0:
        return False
    others = (outline[i] for i in left if i not in {left[at - 1], left[at], left[(at + 1) % len(left)]})
    return not any(_side(a, b, p) >= 0 and _side(b, c, p) >= 0 and _side(c, a, p) >= 0 for p in others)


def _side(a: Floats, b: Floats, c: Floats) -> float:
    """Positive where c is to the left of the way from a to b."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _at(outline: Outline, height: float) -> Face:
    return np.column_stack([outline, np.full(len(outline), height)])
