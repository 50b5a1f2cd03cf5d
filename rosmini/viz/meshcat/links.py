"""What there is to see of a robot's links: meshes and plain shapes of its URDF as surfaces, one for each colour."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rosmini.urdf import Box, Cylinder, Geometry, Material, Mesh, Robot, Sphere, Visual, load
from rosmini.urdf.meshes import Surface, read
from rosmini.urdf.meshes.surface import box, join, lathe, rod
from rosmini.viz.view import ViewError

from .surfaces import LinkPart

GREY = "#98a3ad"
ROUND, BALL = 28, 12
"""Corners of a cylinder; rings of a ball."""


@lru_cache(maxsize=8)
def turtlebot3(model: str) -> Robot:
    """The TurtleBot3 of this name by its description; read once."""
    return load(f"package://turtlebot3_description/urdf/turtlebot3_{model}.urdf.xacro")


def link_parts(node: str, surfaces: list[Surface]) -> list[LinkPart]:
    """The surfaces of a link below a node of the scene."""
    return [
        LinkPart(node, surface.name or str(i), hex_colour(surface), surface)
        for i, surface in enumerate(surfaces)
    ]


def hex_colour(surface: Surface) -> str:
    """The colour of a surface as `#rrggbb`."""
    if surface.colour is None:
        return GREY
    return "#" + "".join(f"{math.floor(255 * part + 0.5):02x}" for part in surface.colour[:3])


def link_surfaces(
    robot: Robot, link: str, *, collisions: bool = False, without: Collection[str] = ()
) -> list[Surface]:
    """What there is to see of a link, in its frame: one surface for each colour.

    A material of the URDF comes before the colours of a mesh file, as in RViz. Surfaces in one of the colours
    `without`, `#rrggbb`, are left out. Raises `MeshError`.
    """
    found: dict[str, list[Surface]] = {}
    described = robot.link(link)
    pieces: list[Visual] = list(described.visuals)
    if collisions:
        pieces = [
            Visual(each.geometry, each.origin, Material("", (0.9, 0.62, 0.0, 1.0)))
            for each in described.collisions
        ]
    for piece in pieces:
        colour = piece.material.colour if piece.material is not None else None
        for surface in surfaces_of(piece.geometry):
            moved = surface.moved(piece.origin.matrix)
            moved = replace(moved, colour=colour or moved.colour)
            if hex_colour(moved) in without:
                continue
            found.setdefault(hex_colour(moved), []).append(moved)
    return [merged(surfaces) for surfaces in found.values()]


def surfaces_of(geometry: Geometry) -> list[Surface]:
    """A shape around its origin."""
    if isinstance(geometry, Box):
        return [join(box((0, 0, 0), geometry.size), GREY)]
    if isinstance(geometry, Cylinder):
        return [rod(geometry.radius, -geometry.length / 2, geometry.length / 2, ROUND)]
    if isinstance(geometry, Sphere):
        angles = [math.pi * (i / BALL - 0.5) for i in range(BALL + 1)]
        rings = [(geometry.radius * math.cos(a), geometry.radius * math.sin(a)) for a in angles]
        rings[0], rings[-1] = (0.0, rings[0][1]), (0.0, rings[-1][1])
        return [lathe(rings, ROUND)]
    return _mesh(geometry)


def _mesh(mesh: Mesh) -> list[Surface]:
    if mesh.path is None:
        raise ViewError(f"the mesh {mesh.filename} was not looked for: load the robot with meshes=True")
    scale = np.diag([*mesh.scale, 1.0])
    return [surface.moved(scale) for surface in read(mesh.path)]


def merged(surfaces: list[Surface]) -> Surface:
    """Several surfaces as one, in the colour of the first."""
    starts = np.cumsum([0, *(len(each.vertices) for each in surfaces)])
    faces = [each.faces + start for each, start in zip(surfaces, starts, strict=False)]
    return Surface(
        np.vstack([each.vertices for each in surfaces]), np.vstack(faces), None, surfaces[0].colour
    )
