"""How Gazebo's messages describe the looks of a model, as surfaces: the visuals or the collisions of its links."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from rosmini.geometry.polygons import area
from rosmini.geometry.products import matrix_product, norm
from rosmini.sim.gazebo.msgs import Collision, Geometry, Link, Model, Pose, Visual
from rosmini.sim.gazebo.snapshot import pose_of, solids_of
from rosmini.sim.sdf.poses import matrix
from rosmini.urdf import Box, Cylinder, Sphere
from rosmini.urdf.meshes import Surface, read

from .links import hex_colour, merged, surfaces_of, upright
from .solids import Floats

SOLID = "#e69e00"
"""The colour of what is solid, as Gazebo's View menu shows it."""
SAME = 1e-6
FLAT = 0.01
"""A level plane that is no higher than this [m] is the ground."""


def transform(pose: Pose) -> Floats:
    """The transform (4, 4) of a pose."""
    return matrix(pose_of(pose))


def surfaces(
    link: Link, place: Floats, *, collisions: bool = False, without: Iterable[str] = ()
) -> list[Surface]:
    """What there is to see of a link at `place` (4, 4) in the world, in its own frame: one surface for each colour.

    The material of a visual comes before the colours of a mesh file, as in Gazebo. Left out are surfaces of a file in
    one of the colours `without`, and planes that are the ground: a scene has its own. Raises `MeshError`.
    """
    found: dict[str, list[Surface]] = {}
    left_out = frozenset(without)
    pieces: tuple[Visual | Collision, ...] = link.collision if collisions else link.visual
    for piece in pieces:
        colour = _rgba(SOLID) if collisions else colour_of(piece)
        if _is_ground(piece, place):
            continue
        for surface in _shape(piece.geometry):
            if hex_colour(surface) in left_out:
                continue
            moved = surface.moved(transform(piece.pose))
            moved = replace(moved, colour=colour or moved.colour)
            found.setdefault(hex_colour(moved), []).append(moved)
    return [merged(several) for several in found.values()]


def _rgba(colour: str) -> tuple[float, float, float, float]:
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return (red, green, blue, 1.0)


def colour_of(piece: Visual | Collision) -> tuple[float, float, float, float] | None:
    """The colour that a visual says itself."""
    if isinstance(piece, Collision) or piece.material is None:
        return None
    diffuse = piece.material.diffuse
    return (diffuse.r, diffuse.g, diffuse.b, diffuse.a)


def _is_ground(piece: Visual | Collision, place: Floats) -> bool:
    plane = piece.geometry.plane
    if plane is None:
        return False
    at = matrix_product(place, transform(piece.pose))
    normal = matrix_product(at[:3, :3], (plane.normal.x, plane.normal.y, plane.normal.z))
    return bool(abs(at[2, 3]) < FLAT and normal[2] > (1 - SAME) * norm(normal))


def _shape(shape: Geometry) -> list[Surface]:
    if shape.box is not None:
        size = shape.box.size
        return surfaces_of(Box((size.x, size.y, size.z)))
    if shape.cylinder is not None:
        return surfaces_of(Cylinder(shape.cylinder.radius, shape.cylinder.length))
    if shape.sphere is not None:
        return surfaces_of(Sphere(shape.sphere.radius))
    if shape.mesh is not None:
        scale = shape.mesh.scale
        stretched = np.diag([scale.x, scale.y, scale.z, 1.0])
        return [each.moved(stretched) for each in read(shape.mesh.filename, shape.mesh.submesh or "")]
    if shape.plane is not None:
        normal, size2 = shape.plane.normal, shape.plane.size
        return [_plane(np.array([normal.x, normal.y, normal.z]), size2.x, size2.y)]
    outlines = [np.array([(point.x, point.y) for point in line.point]) for line in shape.polyline]
    return [
        upright(outline if area(outline) > 0 else outline[::-1], 0.0, shape.polyline[0].height)
        for outline in outlines
    ]


def _plane(normal: Floats, length: float, width: float) -> Surface:
    """A rectangle around the origin, seen from the side that its normal points to."""
    up = normal / norm(normal)
    aside = np.cross(up, (1.0, 0.0, 0.0) if abs(up[0]) < 0.9 else (0.0, 1.0, 0.0))
    aside /= norm(aside)
    ahead = np.cross(aside, up)
    ends = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    corners = [a * length / 2 * ahead + b * width / 2 * aside for a, b in ends]
    return Surface(np.array(corners), np.array([(0, 1, 2), (0, 2, 3)]))


# ---- what is drawn by its solids ----


def is_plain(model: Model) -> bool:
    """Whether a model looks as solid as it is, upright and of one colour, and so is drawn as in other worlds.

    True also without visuals, where Gazebo would show nothing at all.
    """
    visuals = [(link, visual) for link in model.link for visual in link.visual]
    if not visuals:
        return True
    solids = sum(len(solid.parts()) for solid in solids_of(model))
    if solids != len(visuals):
        return False
    there = transform(model.pose) if model.pose is not None else np.eye(4)
    for link in model.link:
        if len(link.visual) != len(link.collision):
            return False
        for visual, collision in zip(link.visual, link.collision, strict=True):
            at, solid_at = transform(visual.pose), transform(collision.pose)
            up = matrix_product(matrix_product(there, transform(link.pose)), at)[2, 2]
            if visual.geometry.mesh is not None or visual.geometry != collision.geometry:
                return False
            if up < 1 - SAME or not np.allclose(at, solid_at, atol=SAME):
                return False
    return True
