"""How far a polygon is from what stands around it: while it moves by less than that it touches nothing, and needs no physics."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def clearance(corners: Floats, segments: Floats, discs: Floats) -> float:
    """The distance [m] between the outline of a polygon with `corners` (k, 2) and the nearest of `segments` (n, 4) and `discs` (m, 3).

    inf if there are none; 0 where something crosses the outline. What lies wholly inside the polygon counts with its distance from the outline.
    """
    nearest = np.inf
    sides = np.hstack([corners, np.roll(corners, -1, axis=0)])
    if len(segments):
        close = _close(corners, segments)
        if _crossing(sides, close):
            return 0.0
        ends = close.reshape(-1, 2)
        nearest = min(_distances(corners, close).min(), _distances(ends, sides).min())
    if len(discs):
        gaps = _distances(discs[:, :2], sides).min(axis=1) - discs[:, 2]
        nearest = min(nearest, gaps.min())
    return max(float(nearest), 0.0)


def _close(corners: Floats, segments: Floats) -> Floats:
    """Those of the segments that can be the nearest, judged by their distance from the polygon's middle."""
    middle = corners.mean(axis=0)
    reach = np.sqrt(((corners - middle) ** 2).sum(axis=1).max())
    away = _distances(middle[None], segments)[0]
    close: Floats = segments[away <= away.min() + 2 * reach]
    return close


def _distances(points: Floats, segments: Floats) -> Floats:
    """The distances (n, m) of each point (n, 2) from each segment (m, 4)."""
    begins, ways = segments[:, :2], segments[:, 2:] - segments[:, :2]
    squares = (ways * ways).sum(axis=1)
    offsets = points[:, None, :] - begins
    along = (offsets * ways).sum(axis=2) / np.where(squares > 0, squares, 1.0)
    gaps = offsets - np.clip(along, 0.0, 1.0)[:, :, None] * ways
    lengths: Floats = np.hypot(gaps[:, :, 0], gaps[:, :, 1])
    return lengths


def _crossing(sides: Floats, segments: Floats) -> bool:
    """Tell whether any of the sides (k, 4) properly crosses any of the segments (n, 4)."""
    a, b = sides[:, None, :2], sides[:, None, 2:]
    c, d = segments[None, :, :2], segments[None, :, 2:]
    return bool(((_turn(a, b, c) * _turn(a, b, d) < 0) & (_turn(c, d, a) * _turn(c, d, b) < 0)).any())


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    """Twice the signed area of the triangles a b c: positive where c lies to the left of the way from a to b."""
    ab, ac = b - a, c - a
    area: Floats = ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]
    return area
