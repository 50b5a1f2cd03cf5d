"""The parts of a mesh: triangles of one colour, in metres."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.products import determinant, matrix_product

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Surface:
    """Triangles of one colour."""

    vertices: Floats
    """Vertices (n, 3) [m]."""
    faces: Ints
    """(m, 3): indices of vertices, counter-clockwise seen from outside."""
    colour: tuple[float, float, float, float] | None = None
    """Red, green, blue, opacity from 0 to 1; None if the file has none."""
    name: str = ""

    @property
    def triangles(self) -> Floats:
        """The vertices of all triangles (m, 3, 3)."""
        return self.vertices[self.faces]

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The minimum and maximum coordinates (3,) of its vertices."""
        corners = self.vertices[self.faces.ravel()]
        return corners.min(axis=0), corners.max(axis=0)

    def moved(self, transform: Floats) -> Self:
        """Return the surface after a transform (4, 4), which may also scale and mirror."""
        linear = transform[:3, :3]
        faces = self.faces if determinant(linear) > 0 else self.faces[:, ::-1]
        return replace(self, vertices=matrix_product(self.vertices, linear.T) + transform[:3, 3], faces=faces)
