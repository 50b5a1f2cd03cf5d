"""What a mesh adds to a scene: its commands for the viewer, and its triangles for the drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rosmini.urdf.meshes import Surface

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LinkPart:
    """A surface of one colour in the frame of its node."""

    node: str
    name: str
    colour: str
    """`#rrggbb`"""
    surface: Surface


def triangles_in_world(part: LinkPart, place: Floats) -> Floats:
    """The corners (m, 3, 3) of its triangles with its node at `place` (4, 4)."""
    corners: Floats = part.surface.triangles @ place[:3, :3].T + place[:3, 3]
    return corners
