"""Overlaps of shapes in the plane, found by pymunk's spatial index and collision tests. Nothing moves here.

pymunk has no wheel for Windows on ARM, and Pyodide does not distribute it; there, our engine's contacts are used.

An outline is an array of vertices (n, 2) in map coordinates [m] and a radius around them. A polygon is simple,
counter-clockwise and has radius 0; a segment has two vertices, a disc one. Overlaps of less than `TOUCH`
count as contact only.
"""

from __future__ import annotations

from collections.abc import Hashable
from functools import cache
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import TOUCH, convex_parts, distances, sides_of

from .outlines import contact

Floats = NDArray[np.float64]


class Outline(NamedTuple):
    """A polygon, a segment or a disc."""

    vertices: Floats
    radius: float = 0.0


class Overlaps(Protocol):
    """Labelled outlines, which can be tested for overlaps."""

    def insert(self, label: Hashable, outline: Outline) -> None:
        """Insert an outline; a label may have several."""

    def remove(self, label: Hashable) -> None:
        """Remove the outlines of a label, if any."""

    def find(self, outline: Outline) -> set[Hashable]:
        """Return the labels of the outlines that overlap with `outline`."""


def no_outlines() -> Overlaps:
    """Return an empty `Overlaps`."""
    return PlainOverlaps() if _pymunk() is None else PymunkOverlaps()


@cache
def _pymunk() -> Any:
    """Import pymunk on first use, as it takes a moment. Returns None where it does not exist."""
    try:
        import pymunk
    except ImportError:
        return None
    return pymunk


def _parts(outline: Outline) -> list[Floats]:
    vertices = outline.vertices
    return convex_parts(vertices) if len(vertices) > 2 else [vertices]


def _shapes(body: Any, outline: Outline, less: float = 0.0) -> list[Any]:
    """Return an outline as convex shapes, shrunk so that their sides are at least `less` [m] nearer to the centres."""
    pymunk, radius = _pymunk(), outline.radius
    found = []
    for part in _parts(outline):
        if len(part) == 1:
            found.append(pymunk.Circle(body, max(radius - less, 0.0), part[0].tolist()))
        elif len(part) == 2:
            found.append(pymunk.Segment(body, *part.tolist(), max(radius - less, 0.0)))
        else:
            centre = part.mean(axis=0)
            nearest = float(distances(centre[None], sides_of(part))[0])
            factor = 1 - less / max(nearest, 2 * less) if less else 1.0
            found.append(pymunk.Poly(body, (centre + (part - centre) * factor).tolist()))
    return found


class PymunkOverlaps:
    """`Overlaps` in a space of pymunk."""

    def __init__(self) -> None:
        self._space = _pymunk().Space()
        self._shapes: dict[Hashable, list[Any]] = {}
        self._labels: dict[Any, Hashable] = {}

    def insert(self, label: Hashable, outline: Outline) -> None:
        """Insert an outline; a label may have several."""
        shapes = _shapes(self._space.static_body, outline)
        self._space.add(*shapes)
        self._shapes.setdefault(label, []).extend(shapes)
        self._labels.update(dict.fromkeys(shapes, label))

    def remove(self, label: Hashable) -> None:
        """Remove the outlines of a label, if any."""
        shapes = self._shapes.pop(label, [])
        self._space.remove(*shapes)
        for shape in shapes:
            del self._labels[shape]
            shape.body = None
        self._space.step(0.0)  # the space refers to removed shapes until its next step

    def find(self, outline: Outline) -> set[Hashable]:
        """Return the labels of the outlines that overlap with `outline`."""
        # pymunk reliably reports contact, but not its depth if centres or sides coincide
        body = _pymunk().Body(body_type=_pymunk().Body.STATIC)  # shapes hold no reference to their body
        probes = _shapes(body, outline, TOUCH)
        return {self._labels[hit.shape] for probe in probes for hit in self._space.shape_query(probe)}


class PlainOverlaps:
    """`Overlaps` without an index: each outline is compared with all others whose boxes overlap."""

    def __init__(self) -> None:
        self._outlines: list[tuple[Hashable, Outline]] = []

    def insert(self, label: Hashable, outline: Outline) -> None:
        """Insert an outline; a label may have several."""
        self._outlines += [(label, Outline(part, outline.radius)) for part in _parts(outline)]

    def remove(self, label: Hashable) -> None:
        """Remove the outlines of a label, if any."""
        self._outlines = [each for each in self._outlines if each[0] != label]

    def find(self, outline: Outline) -> set[Hashable]:
        """Return the labels of the outlines that overlap with `outline`."""
        probes = [Outline(part, outline.radius) for part in _parts(outline)]
        return {label for label, other in self._outlines if any(_overlap(probe, other) for probe in probes)}


def _overlap(a: Outline, b: Outline) -> bool:
    reach = a.radius + b.radius
    apart = np.maximum(a.vertices.min(axis=0) - b.vertices.max(axis=0), b.vertices.min(axis=0) - a.vertices.max(axis=0))
    if apart.max() > reach:
        return False
    return bool(contact(a.vertices, 0, len(a.vertices), a.radius, b.vertices, 0, len(b.vertices), b.radius, TOUCH)[0])
