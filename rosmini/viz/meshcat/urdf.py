"""A robot as its URDF describes it, in three dimensions: any robot, with its joints where one wants them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rosmini.urdf import Box, Cylinder, Geometry, Material, Mesh, Robot, Sphere, Visual
from rosmini.urdf.meshes import Surface, read
from rosmini.urdf.meshes.surface import box, join, lathe, rod
from rosmini.viz.rounding import fixed, snap
from rosmini.viz.view import ViewError

from .scene import ROBOT, Camera, Scene3D
from .surfaces import LinkPart
from .view import HEIGHT, MeshcatView

Floats = NDArray[np.float64]

GREY = "#98a3ad"
ROUND, BALL = 28, 12
"""Corners of a cylinder; rings of a ball."""


def urdf_3d(
    robot: Robot, *, joints: Mapping[str, float] | None = None, collisions: bool = False, distance: float | None = None,
    azimuth: float | None = None, elevation: float | None = None, title: str | None = None, height: int = HEIGHT,
) -> MeshcatView:  # fmt: skip
    """A robot with its joints at these positions [rad or m]; the others as `Robot.positions` has them.

    With `collisions` it shows the shapes that touch others in place of those that one sees.

    Raises:
        UnknownJoint: it has no such joint, or one that no number moves.
        MeshError: a mesh cannot be read.
        ViewError: there is nothing to see, or the distance is not positive.

    """
    if distance is not None and not 0 < distance < 1e4:
        raise ViewError(f"the distance of the camera is a number of metres above 0, not {distance!r}")
    shapes = {name: link_surfaces(robot, name, collisions=collisions) for name in robot.links}
    places = robot.transforms(joints)
    corners = [
        surface.moved(places[name]).vertices for name, surfaces in shapes.items() for surface in surfaces
    ]
    if not corners:
        what = "collision shapes" if collisions else "visual shapes"
        raise ViewError(f"the robot {robot.name!r} has no {what}: there is nothing to see")
    points = np.vstack(corners)
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.linalg.norm(high - low))
    camera = Camera(
        tuple(round(c, 3) for c in snap((low + high) / 2).tolist()),
        round(1.45 * size + 0.02, 3) if distance is None else distance,
        -38.0 if azimuth is None else azimuth,
        20.0 if elevation is None else elevation,
    )
    scene = Scene3D(camera)
    lift = np.eye(4)
    lift[2, 3] = min(0.0, float(snap(low[2]))) * -1.0
    scene.add_ground((float(low[0]), float(low[1]), float(high[0]), float(high[1])))
    add_links(scene, robot, lift, shapes, places)
    shown = [name for name in robot.links if shapes[name]]
    span = " x ".join(fixed(side, 3) for side in (high - low).tolist())
    at = {name: position for name, position in robot.positions(joints).items() if joints and name in joints}
    said = "".join(f"; {name} at {fixed(position, 2)}" for name, position in at.items())
    kind = "collision shapes of " if collisions else ""
    text = (
        f"3D: {kind}{robot.name}, {span} m, {_plural(len(shown), 'link')} to see of {len(robot.links)}{said}"
    )
    alt = f"{robot.name} in three dimensions: {kind and 'its collision shapes, '}{span} metres, with {', '.join(shown)}{said}."
    return MeshcatView(scene, label=f"{robot.name} in 3D", text=text, alt=alt, title=title, height=height)


def add_links(
    scene: Scene3D,
    robot: Robot,
    place: Floats,
    shapes: Mapping[str, list[Surface]] | None = None,
    places: Mapping[str, Floats] | None = None,
    name: str = ROBOT,
) -> None:
    """Add a robot to a scene with its root at a transform (4, 4): a node for each link that has something to see."""
    scene.place(name, place)
    places = robot.transforms() if places is None else places
    for link in robot.links:
        surfaces = link_surfaces(robot, link) if shapes is None else shapes[link]
        if surfaces:
            node = f"{name}/{link}"
            scene.place(node, places[link])
            for i, surface in enumerate(surfaces):
                scene.add_surface(LinkPart(node, surface.name or str(i), hex_colour(surface), surface))


def hex_colour(surface: Surface) -> str:
    """The colour of a surface as `#rrggbb`."""
    if surface.colour is None:
        return GREY
    return "#" + "".join(f"{math.floor(255 * part + 0.5):02x}" for part in surface.colour[:3])


def link_surfaces(robot: Robot, link: str, *, collisions: bool = False) -> list[Surface]:
    """What there is to see of a link, in its frame: one surface for each colour.

    A material of the URDF comes before the colours of a mesh file, as in RViz. Raises `MeshError`.
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
        for surface in _surfaces(piece.geometry):
            moved = surface.moved(piece.origin.matrix)
            moved = replace(moved, colour=colour or moved.colour)
            found.setdefault(hex_colour(moved), []).append(moved)
    return [_merged(surfaces) for surfaces in found.values()]


def _surfaces(geometry: Geometry) -> list[Surface]:
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


def _merged(surfaces: list[Surface]) -> Surface:
    starts = np.cumsum([0, *(len(each.vertices) for each in surfaces)])
    faces = [each.faces + start for each, start in zip(surfaces, starts, strict=False)]
    return Surface(
        np.vstack([each.vertices for each in surfaces]), np.vstack(faces), None, surfaces[0].colour
    )


def _plural(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"
