"""The fixed obstacles of a world, and the test whether they block a footprint."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.polygons import inside
from rosmini.core.geometry.poses import Pose, transform_points
from rosmini.sim.geometry.overlaps import Outline, no_outlines

from .shapes import ROUND, Simple, outline_at

Floats = NDArray[np.float64]
Footprint = Sequence[tuple[float, float]] | Floats | float
"""Vertices (n, 2), counter-clockwise, relative to a pose, or the radius of a disc around it [m]."""


class Fixtures:
    """Walls (n, 4) and fixed obstacles, which can be added and removed; `solid`: the walls enclose solid areas."""

    def __init__(self, walls: Floats, *, solid: bool) -> None:
        self._walls, self._solid = walls, solid
        self._boxes = np.hstack([np.minimum(walls[:, :2], walls[:, 2:]), np.maximum(walls[:, :2], walls[:, 2:])])
        self._overlaps = no_outlines()
        self._bottoms: dict[str, float] = {}

    def insert(self, name: str, bottom: float, parts: Iterable[tuple[Simple, Pose]]) -> None:
        """Insert a fixed obstacle: its name, its lower edge above the ground [m], its shapes and their poses."""
        self._bottoms[name] = bottom
        for shape, pose in parts:
            if isinstance(shape, ROUND):
                self._overlaps.insert(name, Outline(np.array([pose[:2]]), shape.radius))
            else:
                self._overlaps.insert(name, Outline(outline_at(shape, pose)))

    def remove(self, name: str) -> None:
        """Remove an obstacle if it exists."""
        if self._bottoms.pop(name, None) is not None:
            self._overlaps.remove(name)

    def blocked(self, pose: Pose, footprint: Footprint, height: float) -> str | None:
        """Describe what blocks a footprint of this height at `pose`, as `World.blocked` does; None if nothing does."""
        if isinstance(footprint, (int, float)):
            outline = Outline(np.array([pose[:2]], dtype=np.float64), float(footprint))
        else:
            outline = Outline(transform_points(pose, np.asarray(footprint, dtype=np.float64)))
        found = self._overlaps.find(outline)
        for name, bottom in self._bottoms.items() if found else ():
            if name in found and bottom <= height:
                return f"the obstacle {name!r}"
        return self._wall(outline)

    def _wall(self, outline: Outline) -> str | None:
        vertices, radius = outline
        low, high = vertices.min(axis=0) - radius, vertices.max(axis=0) + radius
        near = (self._boxes[:, :2] <= high).all(axis=1) & (self._boxes[:, 2:] >= low).all(axis=1)
        rows = np.flatnonzero(near).tolist()
        if rows:
            walls = no_outlines()
            for row in rows:
                walls.insert(row, Outline(self._walls[row].reshape(2, 2)))
            found = walls.find(outline)
            for row in rows:
                if row in found:
                    x1, y1, x2, y2 = self._walls[row]
                    return f"the wall from ({x1:.2f}, {y1:.2f}) to ({x2:.2f}, {y2:.2f})"
        if self._solid and len(self._walls) and inside(vertices[:1], self._walls)[0]:
            return "the inside of a wall"
        return None
