"""Lines of sight: the object under the mouse, and its position in space. Metres, in the fixed frame (REP 103)."""

from __future__ import annotations

import numpy as np

from rosmini.core.geometry.products import matrix_product, scalar_product

from .primitives import Floats, Mesh

Ray = tuple[Floats, Floats]
"""A line of sight: its start (3,), and its direction (3,), of length 1, away from the viewer."""

HIGH = 1e4
"""Height at which lines of sight begin without perspective [m]."""
_PARALLEL = 1e-6


def ray_from_above(point: Floats) -> Ray:
    """Return the line of sight straight down to a point (3,)."""
    return np.array([point[0], point[1], HIGH]), np.array([0.0, 0.0, -1.0])


def depths(mesh: Mesh, ray: Ray, edge: float = 0.0) -> list[float]:
    """Return the distances at which a line of sight meets faces [m]; `edge` extends faces by this share."""
    triangles = mesh.placed[mesh.faces]
    start, ahead = ray
    u, v = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(ahead, v)
    area = (u * across).sum(axis=1)
    safe = np.where(np.abs(area) > 1e-12, area, np.inf)
    to = start - triangles[:, 0]
    s = (to * across).sum(axis=1) / safe
    turned = np.cross(to, u)
    t = matrix_product(turned, ahead) / safe
    found = (turned * v).sum(axis=1) / safe
    inside = np.isfinite(safe) & (s >= -edge) & (t >= -edge) & (s + t <= 1 + edge) & (found > 0)
    result: list[float] = found[inside].tolist()
    return result


def on_axis(ray: Ray, point: Floats, axis: Floats) -> Floats | None:
    """Return the point (3,) on the line through `point` along `axis` nearest to a line of sight; None if parallel."""
    start, ahead = ray
    slant = scalar_product(ahead, axis)
    if 1 - slant * slant < _PARALLEL:
        return None
    to = start - point
    found: Floats = point + (scalar_product(to, axis) - slant * scalar_product(to, ahead)) / (1 - slant * slant) * axis
    return found


def on_plane(ray: Ray, point: Floats, normal: Floats) -> Floats | None:
    """Return where a line of sight meets the plane through `point` with this `normal`; None if it does not."""
    start, ahead = ray
    slant = scalar_product(ahead, normal)
    if abs(slant) < _PARALLEL:
        return None
    reach = scalar_product(point - start, normal) / slant
    return start + reach * ahead if reach > 0 else None
