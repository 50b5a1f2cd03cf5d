"""Shapes that meshes are put together from: boxes, prisms and what a lathe turns, with normals. Metres; arrays out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from rosmini.core.geometry.products import inverse_matrix, matrix_product, norm, norms
from rosmini.sim.urdf.meshes.surface import Floats, Surface


@dataclass(frozen=True, kw_only=True)
class Shape(Surface):
    """A surface that knows the directions of its vertices."""

    normals: Floats
    """(n, 3) of the vertices."""

    def moved(self, transform: Floats) -> Shape:
        """The shape after a transform (4, 4), which may also stretch and mirror."""
        normals = matrix_product(self.normals, inverse_matrix(transform[:3, :3]))
        normals = normals / (norms(normals)[:, None] + 1e-300)
        return replace(super().moved(transform), normals=normals)

    def at(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Shape:
        """The shape, shifted [m]."""
        return replace(self, vertices=self.vertices + np.array([x, y, z]))


def join(surfaces: Iterable[Shape], colour: str, name: str = "") -> Shape:
    """Several surfaces as one, in a colour `#rrggbb`."""
    several = list(surfaces)
    starts = np.cumsum([0, *(len(each.vertices) for each in several)])
    rgb = [round(int(colour[i : i + 2], 16) / 255, 3) for i in (1, 3, 5)]
    return Shape(
        np.vstack([each.vertices for each in several]),
        np.vstack([each.faces + start for each, start in zip(several, starts, strict=False)]),
        (rgb[0], rgb[1], rgb[2], 1.0),
        name,
        normals=np.vstack([each.normals for each in several]),
    )


def polygon(corners: ArrayLike) -> Shape:
    """A flat convex polygon (n, 3), counter-clockwise seen from outside."""
    points = np.asarray(corners, dtype=float)
    normal = np.cross(points[1] - points[0], points[2] - points[1])
    normal /= norm(normal)
    fan = [(0, i, i + 1) for i in range(1, len(points) - 1)]
    return Shape(points, np.array(fan), normals=np.tile(normal, (len(points), 1)))


def several(polygons: Iterable[ArrayLike]) -> list[Shape]:
    """Polygons, each as `polygon` makes it."""
    return [polygon(corners) for corners in polygons]


def prism(outline: ArrayLike, bottom: float, top: float, *, floor: bool = True) -> list[Shape]:
    """A convex outline (n, 2), counter-clockwise, from `bottom` to `top`; without `floor` it is open below."""
    flat = np.asarray(outline, dtype=float)
    low, high = (np.column_stack([flat, np.full(len(flat), z)]) for z in (bottom, top))
    count = len(flat)
    sides = [np.array([low[i], low[j], high[j], high[i]]) for i, j in ((i, (i + 1) % count) for i in range(count))]
    return several([high, *([low[::-1]] if floor else []), *sides])


def box(centre: Sequence[float], size: Sequence[float]) -> list[Shape]:
    """A box around its centre."""
    (x, y, z), (a, b, c) = centre, (length / 2 for length in size)
    corners = [(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]
    return prism(corners, z - c, z + c)


def lathe(profile: Sequence[tuple[float, float]], corners: int, axis: str = "z") -> Shape:
    """The surface of revolution of a profile of (radius, height), upwards: smooth around the axis, with sharp edges.

    The axis is z, or y from right to left, or x from back to front.
    """
    angles = np.arange(corners) * (2 * math.pi / corners)
    round_ = np.column_stack([np.cos(angles), np.sin(angles)])
    vertices: list[Floats] = []
    normals: list[Floats] = []
    faces: list[tuple[int, int, int]] = []
    for (r0, z0), (r1, z1) in pairwise(profile):
        first = 2 * corners * (len(vertices) // 2)
        out, up = z1 - z0, r0 - r1
        length = math.hypot(out, up)
        for r, z in ((r0, z0), (r1, z1)):
            vertices.append(np.column_stack([round_ * r, np.full(corners, z)]))
            normals.append(np.column_stack([round_ * (out / length), np.full(corners, up / length)]))
        for i in range(corners):
            j = (i + 1) % corners
            low_i, low_j, high_i, high_j = first + i, first + j, first + corners + i, first + corners + j
            if r0 > 0:
                faces.append((low_i, low_j, high_j))
            if r1 > 0:
                faces.append((low_i, high_j, high_i))
    order = {"z": [0, 1, 2], "y": [1, 2, 0], "x": [2, 0, 1]}[axis]
    return Shape(np.vstack(vertices)[:, order], np.array(faces), normals=np.vstack(normals)[:, order])


def rod(radius: float, low: float, high: float, corners: int, axis: str = "z") -> Shape:
    """A cylinder around an axis through the origin."""
    return lathe([(0.0, low), (radius, low), (radius, high), (0.0, high)], corners, axis)
