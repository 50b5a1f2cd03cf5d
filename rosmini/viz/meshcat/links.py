"""The visible parts of a robot's links: meshes and plain shapes of its URDF as surfaces, one per colour."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from rosmini.sim.urdf import Box, Cylinder, Geometry, Material, Mesh, Robot, Sphere, Visual, load
from rosmini.sim.urdf.meshes import Surface, read
from rosmini.viz.view import ViewError

from .solids import Facets, Floats, LinkPart, Prism, mesh, regular, triangulate

GREY = "#98a3ad"
ROUND, BALL = 28, 12
"""Number of vertices around a cylinder; number of rings of a ball."""


@lru_cache(maxsize=8)
def turtlebot3(model: str) -> Robot:
    """Return the TurtleBot3 of this name from its description, which is read once."""
    return load(f"package://turtlebot3_description/urdf/turtlebot3_{model}.urdf.xacro")


def link_parts(node: str, surfaces: list[Surface]) -> list[LinkPart]:
    """Return the surfaces of a link as parts below a node of the scene."""
    return [LinkPart(node, surface.name or str(i), hex_colour(surface), surface) for i, surface in enumerate(surfaces)]


def hex_colour(surface: Surface) -> str:
    """Return the colour of a surface as `#rrggbb`."""
    if surface.colour is None:
        return GREY
    return "#" + "".join(f"{math.floor(255 * part + 0.5):02x}" for part in surface.colour[:3])


def link_surfaces(robot: Robot, link: str, *, collisions: bool = False, without: Collection[str] = ()) -> list[Surface]:
    """Return the visible parts of a link, in its frame: one surface per colour.

    A material of the URDF overrides the colours of a mesh file, as in RViz. Surfaces in one of the colours
    `without`, `#rrggbb`, are left out. Raises `MeshError`.
    """
    found: dict[str, list[Surface]] = {}
    described = robot.link(link)
    pieces: list[Visual] = list(described.visuals)
    if collisions:
        pieces = [
            Visual(each.geometry, each.origin, Material("", (0.9, 0.62, 0.0, 1.0))) for each in described.collisions
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
    """Return a shape around its origin as surfaces."""
    if isinstance(geometry, Box):
        x, y, z = (side / 2 for side in geometry.size)
        return [upright(np.array([(-x, -y), (x, -y), (x, y), (-x, y)]), -z, z)]
    if isinstance(geometry, Cylinder):
        radius, half = geometry.radius, geometry.length / 2
        return [lathe([(0.0, -half), (radius, -half), (radius, half), (0.0, half)])]
    if isinstance(geometry, Sphere):
        angles = [math.pi * (i / BALL - 0.5) for i in range(1, BALL)]
        rings = [(geometry.radius * math.cos(a), geometry.radius * math.sin(a)) for a in angles]
        return [lathe([(0.0, -geometry.radius), *rings, (0.0, geometry.radius)])]
    return _mesh(geometry)


def upright(outline: Floats, bottom: float, top: float) -> Surface:
    """Return an outline (n, 2), counter-clockwise, extruded from `bottom` to `top`, closed."""
    floor = np.column_stack([outline, np.full(len(outline), bottom)])
    below = Facets(tuple(floor[corners[::-1]] for corners in triangulate(outline)))
    return Surface(*mesh([Prism(outline, bottom, top), below]))


def lathe(profile: list[tuple[float, float]], corners: int = ROUND) -> Surface:
    """Return the surface of revolution about z of a profile of (radius, height), upwards, with sharp edges."""
    vertices, faces = [], []
    circle, ahead = regular(corners, 1.0), np.roll(np.arange(corners), -1)
    low = np.arange(corners)
    for (r0, z0), (r1, z1) in pairwise(profile):
        vertices += [np.column_stack([circle * r, np.full(corners, z)]) for r, z in ((r0, z0), (r1, z1))]
        quads = ([(low, ahead, ahead + corners)] if r0 else []) + (
            [(low, ahead + corners, low + corners)] if r1 else []
        )
        faces += [np.column_stack(triangle) + corners * (len(vertices) - 2) for triangle in quads]
    return Surface(np.vstack(vertices), np.vstack(faces))


def _mesh(mesh: Mesh) -> list[Surface]:
    if mesh.path is None:
        raise ViewError(f"the mesh {mesh.filename} was not loaded: load the robot with meshes=True")
    scale = np.diag([*mesh.scale, 1.0])
    return [surface.moved(scale) for surface in read(mesh.path)]


def merged(surfaces: list[Surface]) -> Surface:
    """Merge several surfaces into one, in the colour of the first."""
    starts = np.cumsum([0, *(len(each.vertices) for each in surfaces)])
    faces = [each.faces + start for each, start in zip(surfaces, starts, strict=False)]
    return Surface(np.vstack([each.vertices for each in surfaces]), np.vstack(faces), surfaces[0].colour)
