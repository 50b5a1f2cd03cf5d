"""Markers as primitives: the appearance of a `visualization_msgs/Marker`, whatever its source."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rosmini.core import files
from rosmini.core.errors import RosminiError
from rosmini.core.geometry.products import matrix_product, norm
from rosmini.core.packages import SCHEME, PackageIndex
from rosmini.sim.urdf.meshes import read

from .marker_checks import LINES, SOLIDS, Marker
from .primitives import MAX_POINTS, DisplayError, Floats, Lines, Mesh, Points, Primitive, Text, finite
from .shapes import arrow, ball, box, cylinder, surface_mesh

MAX_SOLIDS = 500
"""A list of more boxes or balls than this is drawn as points of their mean size."""
SHAFT, HEAD = 0.77, 0.23
"""Length of an arrow's shaft and of its head, as a share of its length."""
_UNEVEN = 1e-6


def marker_primitives(marker: Any, pose: Floats) -> Iterator[Primitive]:
    """Yield the primitives of a checked marker whose origin is at `pose` (4, 4) in the fixed frame.

    Raises `DisplayError` if a mesh cannot be read, or for values that the primitives reject.
    """
    kind = marker.type
    scale = np.abs([marker.scale.x, marker.scale.y, marker.scale.z])
    colour = colour_of(marker.color)
    if kind == Marker.CUBE:
        yield box(pose, colour, scale)
    elif kind == Marker.SPHERE:
        yield ball(pose, colour, scale)
    elif kind == Marker.CYLINDER:
        yield cylinder(pose, colour, (scale[0], scale[1]), scale[2])
    elif kind == Marker.ARROW:
        yield from _arrow(marker, pose, scale, colour)
    elif kind == Marker.TEXT_VIEW_FACING:
        yield Text(marker.text.strip(), pose[:3, 3], scale[2], colour)
    elif kind == Marker.MESH_RESOURCE:
        yield from _mesh(marker, pose, scale, colour)
    else:
        yield from _list(marker, pose, scale, colour)


def colour_of(color: Any) -> Floats:
    """Return a `std_msgs/ColorRGBA` as four numbers."""
    return np.array([color.r, color.g, color.b, color.a], dtype=float)


def _list(marker: Any, pose: Floats, scale: Floats, colour: Floats) -> Iterator[Primitive]:
    local = _array(marker.points)
    colours = colour
    if marker.colors:
        colours = np.array([(each.r, each.g, each.b, each.a) for each in marker.colors], dtype=float)
    if marker.type == Marker.TRIANGLE_LIST:
        points = _moved(local * scale, pose)
        faces = np.arange(len(points)).reshape(-1, 3)
        if len(colours) == len(points) and colours.ndim == 2:
            colours = colours.reshape(-1, 3, 4).mean(axis=1)
        yield Mesh(points, faces, colours, lit=False)
        return
    points = _moved(local, pose)
    if marker.type in LINES:
        yield Lines(points, colours, float(scale[0]), strip=marker.type == Marker.LINE_STRIP)
    elif marker.type in SOLIDS:
        yield from _solids(marker.type == Marker.CUBE_LIST, points, pose, scale, colours)
    else:
        yield Points(points, colours, float(scale[0]), "Flat Squares")


def _solids(boxes: bool, points: Floats, pose: Floats, scale: Floats, colours: Floats) -> Iterator[Primitive]:
    even = float(np.ptp(scale)) < _UNEVEN * max(float(scale.max()), _UNEVEN)
    turned = boxes and not np.allclose(pose[:3, :3], np.eye(3))
    if len(points) > MAX_SOLIDS or (even and not turned):
        yield Points(points, colours, float(scale.mean()), "Boxes" if boxes else "Spheres")
        return
    for i, point in enumerate(points):
        place = pose.copy()
        place[:3, 3] = point
        colour = colours[i] if colours.ndim == 2 else colours
        yield box(place, colour, scale) if boxes else ball(place, colour, scale)


def _arrow(marker: Any, pose: Floats, scale: Floats, colour: Floats) -> Iterator[Primitive]:
    if not marker.points:
        yield arrow(matrix_product(pose, np.diag([*scale, 1.0])), colour, SHAFT, 0.5, HEAD, 1.0)
        return
    start, end = _moved(_array(marker.points), pose)
    length = norm(end - start)
    if length > 0:
        head = min(float(scale[2]) or HEAD * length, length)
        yield arrow(towards(start, end), colour, length - head, float(scale[0]) / 2, head, float(scale[1]) / 2)


def towards(start: Floats, end: Floats) -> Floats:
    """Return the pose (4, 4) at `start` (3,) whose x axis points to `end` (3,), a different point."""
    x = (end - start) / norm(end - start)
    y = np.cross((0.0, 0.0, 1.0) if abs(x[2]) < 0.9 else (0.0, 1.0, 0.0), x)
    y /= norm(y)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, y, np.cross(x, y), start
    return pose


def _mesh(marker: Any, pose: Floats, scale: Floats, colour: Floats) -> Iterator[Primitive]:
    try:
        surfaces = read(_mesh_file(marker.mesh_resource))
    except (RosminiError, OSError, ValueError) as error:
        said = str(error).partition("\n")[0]
        raise DisplayError(
            f"Mesh resource marker [{marker.ns}/{marker.id}] could not load [{marker.mesh_resource:.200}]: {said}"
        ) from error
    sized = matrix_product(pose, np.diag([*scale, 1.0]))
    for surface in surfaces:
        own = surface.colour if marker.mesh_use_embedded_materials else None
        if own is None:
            yield surface_mesh(surface, colour, sized)
        else:
            yield surface_mesh(surface, np.array(own) * colour if colour.any() else None, sized)


def _mesh_file(resource: str) -> Path:
    if resource.startswith(SCHEME):
        return PackageIndex().resolve(resource)
    if resource.startswith("file://"):
        return Path(files.path_of(resource))
    raise DisplayError("a mesh URL must begin with package:// or file://")


def _array(points: Sequence[Any]) -> Floats:
    if len(points) > MAX_POINTS:
        raise DisplayError(f"{len(points)} points are too many to draw: at most {MAX_POINTS}")
    return finite([(each.x, each.y, each.z) for each in points], 3)


def _moved(points: Floats, pose: Floats) -> Floats:
    moved: Floats = matrix_product(points, pose[:3, :3].T) + pose[:3, 3]
    return moved
