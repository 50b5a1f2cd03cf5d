"""The visuals of the links of a Gazebo model, as surfaces."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from rosmini.core.geometry.polygons import area
from rosmini.core.geometry.products import matrix_product, norm
from rosmini.sim.gazebo.snapshot import ShownLink, ShownModel
from rosmini.sim.sdf.document import SdfGeometry, SdfVisual
from rosmini.sim.sdf.poses import matrix
from rosmini.sim.urdf import Box, Cylinder, Sphere
from rosmini.sim.urdf.meshes import Surface, read

from .links import hex_colour, merged, surfaces_of, upright
from .solids import Floats

SAME = 1e-6
FLAT = 0.01
"""A level plane within this height [m] of 0 counts as the ground."""


def surfaces(link: ShownLink, place: Floats, *, without: Iterable[str] = ()) -> list[Surface]:
    """Return the visible surfaces of a link at `place` (4, 4) in the world, in its own frame: one per colour.

    The material of a visual overrides the colours of a mesh file, as in Gazebo. Surfaces of a file in a colour of
    `without` are left out, and so are planes that form the ground, since a scene has its own. Raises `MeshError`.
    """
    found: dict[str, list[Surface]] = {}
    left_out = frozenset(without)
    for piece in link.visuals:
        colour = colour_of(piece)
        if _is_ground(piece, place):
            continue
        for surface in _shape(piece.geometry):
            if hex_colour(surface) in left_out:
                continue
            moved = surface.moved(matrix(piece.pose))
            moved = replace(moved, colour=colour or moved.colour)
            found.setdefault(hex_colour(moved), []).append(moved)
    return [merged(several) for several in found.values()]


def _rgba(colour: str) -> tuple[float, float, float, float]:
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return (red, green, blue, 1.0)


def colour_of(piece: SdfVisual) -> tuple[float, float, float, float] | None:
    """Return the colour of the visual's own material, if it has one."""
    return None if piece.colour is None else _rgba(piece.colour)


def _is_ground(piece: SdfVisual, place: Floats) -> bool:
    if piece.geometry.kind != "plane":
        return False
    at = matrix_product(place, matrix(piece.pose))
    normal = matrix_product(at[:3, :3], piece.geometry.normal)
    return bool(abs(at[2, 3]) < FLAT and normal[2] > (1 - SAME) * norm(normal))


def _equal(one: SdfGeometry, other: SdfGeometry) -> bool:
    """Return True if two shapes are equal, whatever line of the file they come from."""
    return replace(one, line=0) == replace(other, line=0)


def _shape(shape: SdfGeometry) -> list[Surface]:
    match shape.kind:
        case "box":
            x, y, z = shape.size
            return surfaces_of(Box((x, y, z)))
        case "cylinder":
            return surfaces_of(Cylinder(shape.radius, shape.length))
        case "sphere":
            return surfaces_of(Sphere(shape.radius))
        case "mesh" if shape.mesh is not None:
            stretched = np.diag([*shape.scale, 1.0])
            return [each.moved(stretched) for each in read(shape.mesh, shape.submesh)]
        case "plane":
            return [_plane(np.array(shape.normal), *shape.size)]
    outlines = [np.array(outline) for outline in shape.outlines]
    return [upright(outline if area(outline) > 0 else outline[::-1], 0.0, shape.length) for outline in outlines]


def _plane(normal: Floats, length: float, width: float) -> Surface:
    """Return a rectangle around the origin, visible from the side that its normal points to."""
    up = normal / norm(normal)
    aside = np.cross(up, (1.0, 0.0, 0.0) if abs(up[0]) < 0.9 else (0.0, 1.0, 0.0))
    aside /= norm(aside)
    ahead = np.cross(aside, up)
    ends = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    corners = [a * length / 2 * ahead + b * width / 2 * aside for a, b in ends]
    return Surface(np.array(corners), np.array([(0, 1, 2), (0, 2, 3)]))


# ---- models drawn by their collision shapes ----


def is_plain(model: ShownModel) -> bool:
    """Return True if a model's visuals equal its collision shapes, upright and in one colour, so that these are drawn.

    Also true without visuals, where Gazebo would show nothing at all.
    """
    visuals = [(link, visual) for link in model.links for visual in link.visuals]
    if not visuals:
        return True
    solids = sum(len(solid.parts()) for solid in model.placed_solids())
    if solids != len(visuals):
        return False
    there = matrix(model.pose)
    for link in model.links:
        if len(link.visuals) != len(link.collisions):
            return False
        for visual, collision in zip(link.visuals, link.collisions, strict=True):
            at, solid_at = matrix(visual.pose), matrix(collision.pose)
            up = matrix_product(matrix_product(there, matrix(link.pose)), at)[2, 2]
            if visual.geometry.mesh is not None or not _equal(visual.geometry, collision.geometry):
                return False
            if up < 1 - SAME or not np.allclose(at, solid_at, atol=SAME):
                return False
    return True
