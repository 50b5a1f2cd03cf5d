"""Find the object under the mouse and the objects in a rectangle: for the tools, and for the Selection panel."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from rosmini.core.geometry.products import matrix_product, norms, scalar_product

from .display import Display
from .primitives import Floats, Mesh, Primitive, Text, Texture
from .projection import Projection
from .rays import Ray, depths
from .scene import Layer

REACH = 6.0
"""Maximum distance from the mouse at which something is hit [px]."""
DEEP = 0.1
"""Distance behind a surface from which things are hidden by it [m]."""
MAX_LISTED = 10
"""Maximum number of positions that the panel lists for a display."""


class Picked(NamedTuple):
    """The selected part of a display."""

    display: Display
    number: int
    """Number of points, corners or texts."""
    positions: Floats
    """Positions of the first of them (n, 3), in the fixed frame [m]."""

    def words(self) -> str:
        """Return the text for the panel."""
        lines = [f"{self.display.name} ({self.display.plugin_name}): {self.number} selected"]
        lines += [f"  Position: {x:.3f}; {y:.3f}; {z:.3f}" for x, y, z in self.positions]
        if self.number > len(self.positions):
            lines.append(f"  ... and {self.number - len(self.positions)} more")
        return "\n".join(lines)


def picked(layers: Iterable[Layer], projection: Projection, first: Floats, last: Floats) -> list[Picked]:
    """Return what lies inside the rectangle between two pixels (2,), display by display, in their order."""
    low, high = np.minimum(first, last), np.maximum(first, last)
    found = []
    for layer in layers:
        inside = [np.empty((0, 3))]
        for places in _places(layer.primitives):
            shown = projection.pixels(places)
            inside.append(places[((shown >= low) & (shown <= high)).all(axis=1)])
        hits = np.vstack(inside)
        if len(hits):
            found.append(Picked(layer.display, len(hits), hits[:MAX_LISTED]))
    return found


def hit(layers: Iterable[Layer], projection: Projection, pixel: Floats) -> Floats | None:
    """Return the point (3,) of the fixed frame visible at a pixel (2,): of a surface, of a point near it, or of a map.

    A surface hides things behind it. Returns None where nothing is drawn.
    """
    shown = [each for layer in layers for each in layer.primitives]
    ray = projection.ray(float(pixel[0]), float(pixel[1]))
    surface = first_hit((each for each in shown if isinstance(each, Mesh)), ray)
    farthest = math.inf if surface is None else _depth(surface, ray) + DEEP
    best: Floats | None = None
    nearest = REACH
    for places in _places(each for each in shown if surface is None or not isinstance(each, Mesh)):
        distances = norms(projection.pixels(places) - pixel)
        distances[matrix_product(places - ray[0], ray[1]) > farthest] = np.inf
        index = int(np.argmin(distances))
        if distances[index] < nearest:
            best, nearest = places[index], float(distances[index])
    if best is not None or surface is not None:
        return surface if best is None else best
    ground = np.array(projection.metres(float(pixel[0]), float(pixel[1])))
    return ground if any(isinstance(each, Texture) and _covers(each, ground) for each in shown) else None


def first_hit(meshes: Iterable[Mesh], ray: Ray) -> Floats | None:
    """Return the point (3,) of the surfaces that a line of sight meets first, or None."""
    found = [depth for mesh in meshes for depth in depths(mesh, ray)]
    return ray[0] + min(found) * ray[1] if found else None


def _depth(point: Floats, ray: Ray) -> float:
    return scalar_product(point - ray[0], ray[1])


def _places(primitives: Iterable[Primitive]) -> Iterator[Floats]:
    """Yield the points of primitives that have any; textures are hit anywhere, so they have none."""
    for primitive in primitives:
        if isinstance(primitive, Texture):
            continue
        if isinstance(primitive, Text):
            yield primitive.position[None]
        else:
            places = primitive.placed if isinstance(primitive, Mesh) else primitive.points
            if len(places):
                yield places


def _covers(texture: Texture, ground: Floats) -> bool:
    x, y, _ = matrix_product(texture.pose[:3, :3].T, ground - texture.pose[:3, 3])
    return bool(0 <= x <= texture.size[0] and 0 <= y <= texture.size[1])
