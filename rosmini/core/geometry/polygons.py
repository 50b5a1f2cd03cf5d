"""Polygons in the plane: points inside them, crossing sides, distances, convex parts.

An outline is an array of corners (n, 2); its last corner is connected to the first.

Overlaps of less than `TOUCH` count as contact only.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

from rosmini.core.lazy import np

from .products import scalar_product

if TYPE_CHECKING:
    from numpy.typing import NDArray

Floats: TypeAlias = "NDArray[np.float64]"
Bools: TypeAlias = "NDArray[np.bool_]"

TOUCH = 1e-6
"""Maximum overlap that counts as contact only [m]."""


def sides_of(outline: Floats) -> Floats:
    """Return the sides (n, 4) of a closed outline (n, 2), each x1, y1, x2, y2."""
    return np.hstack([outline, np.roll(outline, -1, axis=0)])


def area(outline: Floats) -> float:
    """Return the area inside an outline [m2]; negative if it is clockwise."""
    x, y = outline.T
    return float((x * np.roll(y, -1)).sum() - (y * np.roll(x, -1)).sum()) / 2


def inside(points: Floats, sides: Floats) -> Bools:
    """Return which of the points (n, 2) are inside the closed outlines made of `sides` (m, 4), by the even-odd rule."""
    x, y = points[:, :1], points[:, 1:]
    x1, y1, x2, y2 = sides.T
    crossing = (y1 > y) != (y2 > y)
    with np.errstate(over="ignore"):  # nearly horizontal sides
        at = x1 + (y - y1) * (x2 - x1) / np.where(y1 == y2, 1.0, y2 - y1)
    odd: Bools = np.count_nonzero(crossing & (x < at), axis=1) % 2 == 1
    return odd


def distances(points: Floats, sides: Floats) -> Floats:
    """Return the distance [m] from each of the points (n, 2) to the nearest of `sides` (m, 4); inf without sides."""
    nearest: Floats = distances_to_sides(points, sides).min(axis=1, initial=np.inf)
    return nearest


def distances_to_sides(points: Floats, sides: Floats) -> Floats:
    """Return the distance [m] from each of the points (n, 2) to each of `sides` (m, 4), as (n, m)."""
    begin, direction = sides[:, :2], sides[:, 2:] - sides[:, :2]
    squares = (direction * direction).sum(axis=1)
    offset = points[:, None, :] - begin
    along = np.clip((offset * direction).sum(axis=2) / np.where(squares > 0, squares, 1.0), 0.0, 1.0)
    gaps = offset - along[..., None] * direction
    lengths: Floats = np.hypot(gaps[..., 0], gaps[..., 1])
    return lengths


def simplified_indices(fixed: Sequence[int], gaps: Callable[[int, int], Floats], tolerance: float) -> list[int]:
    """Return the indices of the points, including `fixed`, that draw a line within `tolerance` of all the others.

    `gaps(first, last)` returns the distances of the points between these indices from the line without them (Douglas
    and Peucker, "Algorithms for the reduction of the number of points required to represent a digitized line or its
    caricature", 1973). The unit is that of `tolerance`.

    Distances are rounded to billionths, since their last bits differ between processors: of points at equal distances,
    such as two on an arc, the first is chosen.
    """
    found = set(fixed)
    waiting = [(first, last) for first, last in pairwise(fixed) if last - first > 1]
    while waiting:
        first, last = waiting.pop()
        off = np.round(gaps(first, last), 9)
        if off[worst := int(off.argmax())] > tolerance:
            middle = first + 1 + worst
            found.add(middle)
            waiting += [(a, b) for a, b in ((first, middle), (middle, last)) if b - a > 1]
    return sorted(found)


def crossing_sides(outline: Floats) -> tuple[int, int] | None:
    """Return the indices of the first two sides of an outline (n, 2) that cross, or None; side i begins at corner i."""
    count = len(outline)
    ends = np.roll(outline, -1, axis=0)
    for first in range(count):
        direction, following = ends[first] - outline[first], ends[(first + 1) % count] - ends[first]
        if (
            _cross(direction, following) == 0 and scalar_product(direction, following) <= 0
        ):  # back along the same line, or a side of length 0
            return first, (first + 1) % count
        others = slice(first + 2, count - (first == 0))
        meeting = np.flatnonzero(_intersects(outline[first], ends[first], outline[others], ends[others]))
        if len(meeting):
            return first, first + 2 + int(meeting[0])
    return None


def convex_parts(outline: Floats) -> list[Floats]:
    """Return a small, not always minimal, number of convex polygons that make up a counter-clockwise polygon (n, 2).

    Triangles are cut off at convex corners (Meisters, Polygons have ears, 1975), and then joined again
    across every side that is not needed (Hertel and Mehlhorn, Fast triangulation of simple polygons, 1983).
    """
    corners = [(float(x), float(y)) for x, y in outline]
    ring = [i for i, corner in enumerate(corners) if corner != corners[i - 1]]
    if _is_convex(ring, corners):
        return [np.array([corners[i] for i in ring])]
    parts: list[list[int]] = []
    while len(ring) > 3:
        ear = next((k for k in range(len(ring)) if _is_ear(k, ring, corners)), None)
        if ear is None:  # rounding: the rest has no area
            break
        parts.append([ring[ear - 1], ring[ear], ring[(ear + 1) % len(ring)]])
        del ring[ear]
    if len(ring) == 3:
        parts.append(ring)
    parts = [part for part in parts if _turn(*(corners[i] for i in part)) > 0]
    joined = True
    while joined:
        joined = _join(parts, corners)
    return [np.array([corners[i] for i in part]) for part in parts]


def _turn(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> float:
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])


def _is_convex(ring: list[int], corners: Sequence[Sequence[float]]) -> bool:
    return all(_turn(corners[ring[k - 2]], corners[ring[k - 1]], corners[ring[k]]) >= 0 for k in range(len(ring)))


def _is_ear(k: int, ring: list[int], corners: Sequence[Sequence[float]]) -> bool:
    """Return whether the triangle at a corner lies inside the polygon and contains no other corner."""
    i, j, m = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
    a, b, c = corners[i], corners[j], corners[m]
    if _turn(a, b, c) < 0:
        return False
    return not any(
        min(_turn(a, b, p), _turn(b, c, p), _turn(c, a, p)) >= 0 and p not in (a, b, c)
        for p in (corners[n] for n in ring if n not in (i, j, m))
    )


def _join(parts: list[list[int]], corners: Sequence[Sequence[float]]) -> bool:
    """Join the first two parts whose union is convex; return False if there are none."""
    for one in parts:
        for other in parts:
            for k, i in enumerate(one):
                j = one[(k + 1) % len(one)]
                if one is other or i not in other or other[other.index(i) - 1] != j:
                    continue
                at = other.index(i)
                between = (other[at + 1 :] + other[:at])[:-1]
                ring = [*one[: k + 1], *between, *one[k + 1 :]]
                if _is_convex(ring, corners):
                    parts.remove(other)
                    one[:] = ring
                    return True
    return False


def _cross(a: Floats, b: Floats) -> Floats:
    product: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product


def _intersects(a: Floats, b: Floats, c: Floats, d: Floats) -> NDArray[np.bool_]:
    """Return which of the segments c d (n, 2) have a point in common with the segment a b."""
    c_side, d_side, a_side, b_side = (
        _cross(b - a, c - a),
        _cross(b - a, d - a),
        _cross(d - c, a - c),
        _cross(d - c, b - c),
    )
    on_one_line = (c_side == 0) & (d_side == 0) & (a_side == 0) & (b_side == 0)
    low = np.maximum(np.minimum(a, b), np.minimum(c, d))
    high = np.minimum(np.maximum(a, b), np.maximum(c, d))
    across: NDArray[np.bool_] = (c_side * d_side <= 0) & (a_side * b_side <= 0)
    return np.where(on_one_line, (low <= high).all(axis=1), across)
