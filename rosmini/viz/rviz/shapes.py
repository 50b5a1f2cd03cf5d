"""Solid shapes as meshes: arrows and axes as RViz draws them, boxes, cylinders, balls, ellipsoids.

Each is made once for its sizes and then only placed, so that a thousand equal arrows share one geometry.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rosmini.core.geometry.products import matrix_product
from rosmini.sim.urdf import Box, Cylinder, Sphere
from rosmini.sim.urdf.meshes import Surface
from rosmini.viz.meshcat.links import lathe, surfaces_of

from .primitives import Floats, Lines, Mesh

RED, GREEN, BLUE = (np.array(colour) for colour in ((1.0, 0, 0, 1), (0, 1.0, 0, 1), (0, 0, 1.0, 1)))
"""The colours of axes: x, y, z."""

_ALONG_X = np.array([[0.0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
"""Rotates z to x."""
_ALONG_Y = np.array([[0.0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
"""Rotates z to y."""


def arrow(
    pose: Floats, colour: Floats, shaft_length: float, shaft_radius: float, head_length: float, head_radius: float
) -> Mesh:
    """Return an arrow along x from the origin of `pose` (4, 4); lengths and radii in metres."""
    found = _arrow(*(round(float(each), 6) for each in (shaft_length, shaft_radius, head_length, head_radius)))
    return Mesh(found.vertices, found.faces, colour, pose)


def flat_arrow(pose: Floats, colour: Floats, length: float) -> Lines:
    """Return an arrow of three lines in the xy plane of `pose`, like those of a PoseArray."""
    tip, back, side = (length, 0.0, 0.0), 0.75 * length, 0.2 * length
    flat = np.array([(0, 0, 0), tip, tip, (back, side, 0), tip, (back, -side, 0)], dtype=float)
    return Lines(matrix_product(flat, pose[:3, :3].T) + pose[:3, 3], colour, strip=False)


def axes(pose: Floats, length: float, radius: float, alpha: float = 1.0) -> tuple[Mesh, Mesh, Mesh]:
    """Return the axes of `pose`: x red, y green, z blue."""
    found = _rod(round(float(length), 6), round(float(radius), 6))
    turned = (_ALONG_X, _ALONG_Y, np.eye(4))
    x, y, z = (
        Mesh(found.vertices, found.faces, colour * (1, 1, 1, alpha), matrix_product(pose, turn))
        for colour, turn in zip((RED, GREEN, BLUE), turned, strict=True)
    )
    return x, y, z


def box(pose: Floats, colour: Floats, size: tuple[float, float, float] | Floats) -> Mesh:
    """Return a box around the origin of `pose`."""
    return surface_mesh(_box(), colour, matrix_product(pose, np.diag([*size, 1.0])))


def cylinder(pose: Floats, colour: Floats, diameters: tuple[float, float], height: float) -> Mesh:
    """Return a cylinder along z around the origin of `pose`, with diameters along x and y."""
    return surface_mesh(_cylinder(), colour, matrix_product(pose, np.diag([*diameters, height, 1.0])))


def cone(pose: Floats, colour: Floats, length: float, radius: float) -> Mesh:
    """Return a cone with its tip at the origin of `pose`, opening along x."""
    return surface_mesh(_cone(), colour, matrix_product(pose, np.diag([length, radius, radius, 1.0])))


def ball(pose: Floats, colour: Floats, size: tuple[float, float, float] | Floats) -> Mesh:
    """Return an ellipsoid around the origin of `pose`; `size` are its diameters."""
    return surface_mesh(_ball(), colour, matrix_product(pose, np.diag([*size, 1.0])))


def surface_mesh(surface: Surface, colour: Floats | None = None, pose: Floats | None = None) -> Mesh:
    """Return a surface as a mesh, in its own colour or another one."""
    if colour is None:
        colour = np.array(surface.colour or (0.6, 0.6, 0.6, 1.0))
    return Mesh(surface.vertices, surface.faces, colour, pose)


def outline(points: Floats, colour: Floats, width: float = 0.0) -> Lines:
    """Return a closed line through points (n, 3) of the fixed frame."""
    return Lines(np.vstack([points, points[:1]]) if len(points) else points, colour, width)


@lru_cache(maxsize=256)
def _arrow(shaft: float, radius: float, head: float, wide: float) -> Surface:
    whole = shaft + head
    profile = [(0.0, 0.0), (radius, 0.0), (radius, shaft), (wide, shaft), (0.0, whole)]
    return lathe(profile, corners=8).moved(_ALONG_X)


@lru_cache(maxsize=256)
def _rod(length: float, radius: float) -> Surface:
    return lathe([(0.0, 0.0), (radius, 0.0), (radius, length), (0.0, length)], corners=8)


@lru_cache(maxsize=1)
def _box() -> Surface:
    return surfaces_of(Box((1.0, 1.0, 1.0)))[0]


@lru_cache(maxsize=1)
def _cone() -> Surface:
    return lathe([(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)], corners=24).moved(_ALONG_X)


@lru_cache(maxsize=1)
def _cylinder() -> Surface:
    return surfaces_of(Cylinder(0.5, 1.0))[0]


@lru_cache(maxsize=1)
def _ball() -> Surface:
    return surfaces_of(Sphere(0.5))[0]
