"""Solid shapes for both the viewer and the drawing: prisms, rods and balls, in metres.

A part has one colour and is given in the frame of its node (`robot/wheel_left`). Round shapes are round in the viewer
and polygonal in the drawing.
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
"""Vertices (n, 2) of a simple polygon, counter-clockwise seen from above."""
Face = Floats
"""Vertices (n, 3) of a flat polygon, counter-clockwise seen from outside."""

RESOLUTION = 1e-5
"""Resolution to which coordinates are rounded [m], so that they are equal on every machine."""


def rounded(values: Floats) -> Floats:
    """Return `values` rounded to a hundredth of a millimetre, without negative zeros."""
    return snap(values, RESOLUTION)


@dataclass(frozen=True)
class Prism:
    """A polygon extruded from `bottom` to `top`, open at the bottom."""

    outline: Outline
    bottom: float
    top: float

    def faces(self) -> Iterator[Face]:
        """Yield the top, then the sides."""
        yield _at(self.outline, self.top)
        low, high = _at(self.outline, self.bottom), _at(self.outline, self.top)
        for i in range(len(self.outline)):
            j = (i + 1) % len(self.outline)
            yield np.array([low[i], low[j], high[j], high[i]])

    def triangles(self) -> Iterator[tuple[Face, NDArray[np.int64]]]:
        """Yield the faces, each with its triangles (m, 3) as indices of its vertices."""
        top, *sides = self.faces()
        yield top, triangulate(self.outline)
        for side in sides:
            yield side, np.array([(0, 1, 2), (0, 2, 3)])


@dataclass(frozen=True)
class Facets:
    """Convex polygons in any position."""

    polygons: tuple[Face, ...]

    def faces(self) -> Iterator[Face]:
        """Yield the polygons."""
        yield from self.polygons

    def triangles(self) -> Iterator[tuple[Face, NDArray[np.int64]]]:
        """Yield each polygon with a fan of triangles around its first vertex."""
        for face in self.polygons:
            yield face, np.array([(0, i, i + 1) for i in range(1, len(face) - 1)])


@dataclass(frozen=True)
class Rod:
    """A cylinder, given by its centre; its axis is z, or y from right to left."""

    centre: tuple[float, float, float]
    radius: float
    length: float
    axis: Literal["y", "z"] = "z"

    def faces(self) -> Iterator[Face]:
        """Yield the two ends, then the sides; thin rods have fewer."""
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
            # A quarter turn about x takes z to -y: mirror it, so that the axis points to the left.
            turned = face if self.axis == "z" else np.column_stack([face[:, 0], face[:, 2], -face[:, 1]])
            yield turned + self.centre


@dataclass(frozen=True)
class Ball:
    """A sphere."""

    centre: tuple[float, float, float]
    radius: float

    def faces(self) -> Iterator[Face]:
        """Yield quadrilaterals between circles of latitude."""
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
    """Specular reflection, 0 to 1."""
    fine: bool = False
    """True to leave the part out of the drawing."""


@dataclass(frozen=True)
class LinkPart:
    """A surface of one colour, read from a mesh, in the frame of its node."""

    node: str
    name: str
    colour: str
    """`#rrggbb`"""
    surface: Surface


def box(x: float, y: float, z: float, length: float, width: float, height: float) -> Prism:
    """Return a box centred at (x, y) whose bottom is at z."""
    a, b = length / 2, width / 2
    return Prism(np.array([(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]), z, z + height)


def plate(x: float, y: float, length: float, width: float, radius: float, corners: int = 5) -> Outline:
    """Return the outline of a rectangle around (x, y) with round corners."""
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
    """Return a regular polygon around the origin."""
    angles = np.arange(corners) * (2 * math.pi / corners)
    return np.column_stack([np.cos(angles), np.sin(angles)]) * radius


def mesh(flat: Iterable[Prism | Facets]) -> tuple[Floats, NDArray[np.int64]]:
    """Return the vertices (n, 3) and triangles (m, 3) of all solids. Faces share no vertices, to keep edges sharp."""
    vertices, triangles, count = [], [], 0
    for solid in flat:
        for face, among in solid.triangles():
            vertices.append(face)
            triangles.append(among + count)
            count += len(face)
    return rounded(np.vstack(vertices)), np.vstack(triangles)


def triangulate(outline: Outline) -> NDArray[np.int64]:
    """Return the triangles (n - 2, 3) of a simple polygon (n, 2), found by ear clipping; all are counter-clockwise."""
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
    """Return a positive number if c is to the left of the line from a to b."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _at(outline: Outline, height: float) -> Face:
    return np.column_stack([outline, np.full(len(outline), height)])
