"""Solids seen from above: hulls of points, sections of meshes, and decomposition into simple polygons."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry import polygons
from rosmini.core.geometry.errors import GeometryError

from .overlaps import Outline, no_outlines

Floats = NDArray[np.float64]

AT_ONCE = 1_000_000
"""Number of pairs of sides compared at once."""

MAX_SPLITS = 2_000_000
"""Maximum product of the number of sides and the number of heights at which outlines are split."""


def convex_hull(points: Floats) -> Floats:
    """Return the corners (k, 2), counter-clockwise, of the convex hull of points (n, 2).

    No corner is collinear with its neighbours. Andrew's monotone chain (Information Processing Letters 9, 1979). For
    collinear points the hull is their two ends.
    """
    ordered = np.unique(np.asarray(points, dtype=np.float64), axis=0)
    if len(ordered) < 3:
        return ordered
    scale = float(np.abs(ordered).max()) or 1.0
    rows = ordered.tolist()

    def chain(rows: list[list[float]]) -> list[list[float]]:
        found: list[list[float]] = []
        for x, y in rows:
            while len(found) > 1:
                (x1, y1), (x2, y2) = found[-2:]
                if (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1) > 1e-12 * scale * scale:
                    break
                found.pop()
            found.append([x, y])
        return found

    return np.array(chain(rows)[:-1] + chain(rows[::-1])[:-1])


def cut(triangles: Floats, height: float) -> Floats:
    """Return the section of triangles (n, 3, 3) at a height: segments (m, 4), each x1, y1, x2, y2.

    Corners at that height count as above it.
    """
    above = triangles[..., 2] >= height
    sides = above.sum(axis=1)
    crossing = (sides > 0) & (sides < 3)
    hit, up = triangles[crossing], above[crossing]
    # The corner that is alone on its side of the plane comes first; its two sides cross the plane.
    alone = np.where(up.sum(axis=1) == 1, up.argmax(axis=1), (~up).argmax(axis=1))
    order = (alone[:, None] + np.arange(3)) % 3
    tip, *others = (hit[np.arange(len(hit)), order[:, i]] for i in range(3))
    ends = []
    for other in others:
        low = np.where(
            (tip[:, 2] < other[:, 2])[:, None], tip, other
        )  # both triangles of a side compute the same point
        high = np.where((tip[:, 2] < other[:, 2])[:, None], other, tip)
        part = (height - low[:, 2]) / (high[:, 2] - low[:, 2])
        ends.append(low[:, :2] + part[:, None] * (high[:, :2] - low[:, :2]))
    segments: Floats = np.hstack(ends) if len(hit) else np.empty((0, 4))
    return segments[(np.abs(segments[:, :2] - segments[:, 2:]) > 1e-9).any(axis=1)]


def loops(segments: Floats, grain: float = 1e-6) -> list[Floats] | None:
    """Return the closed outlines (k, 2) that segments (n, 4) form, or None if a segment does not continue.

    Ends closer than about `grain` [m] are merged. Each outline is counter-clockwise; collinear corners
    are left out.
    """
    keys = np.round(segments.reshape(-1, 2) / grain).astype(np.int64)
    _, first, names = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    places = segments.reshape(-1, 2)[first]
    pairs = {tuple(sorted(pair)) for pair in names.reshape(-1, 2).tolist() if pair[0] != pair[1]}
    beside: dict[int, list[int]] = {}
    for a, b in sorted(pairs):
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    if any(len(each) % 2 for each in beside.values()):
        return None
    found = []
    for start in sorted(beside):
        while beside[start]:
            way = [start]
            while True:
                after = beside[way[-1]].pop(0)
                beside[after].remove(way[-1])
                if after == start:
                    break
                way.append(after)
            outline = _plain(places[way])
            if len(outline) >= 3:
                found.append(outline if polygons.area(outline) > 0 else outline[::-1])
    return found


def _plain(outline: Floats) -> Floats:
    """Return an outline without its collinear corners."""
    before, after = outline - np.roll(outline, 1, axis=0), np.roll(outline, -1, axis=0) - outline
    bend = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    lengths = np.hypot(*before.T) * np.hypot(*after.T)
    kept: Floats = outline[np.abs(bend) > 1e-6 * np.maximum(lengths, 1e-12)]
    return kept


def thinned(outline: Floats, tolerance: float) -> Floats:
    """Return an outline (k, 2) with fewer corners, within `tolerance` [m] of it; see `polygons.simplified_indices`."""
    if len(outline) <= 4:
        return outline
    far = int(np.hypot(*(outline - outline[0]).T).argmax())
    closed = np.vstack([outline, outline[:1]])

    def gaps(first: int, last: int) -> Floats:
        chord = np.concatenate([closed[first], closed[last]])[None]
        return polygons.distances(closed[first + 1 : last], chord)

    return closed[polygons.simplified_indices([0, far, len(outline)], gaps, tolerance)[:-1]]


def _overlapping(outlines: list[Floats]) -> bool:
    """Return whether any two of some simple polygons overlap."""
    if len(outlines) < 2:
        return False
    seen = no_outlines()
    for number, outline in enumerate(outlines):
        if seen.find(Outline(outline)):
            return True
        seen.insert(number, Outline(outline))
    return False


def pieces(outlines: list[Floats]) -> list[Floats]:
    """Return simple counter-clockwise polygons that together cover the inside of outlines, by the even-odd rule.

    Outlines that neither cross themselves nor overlap others are returned whole; the others are split into trapezoids
    between the heights of their corners. The pieces cover the same points up to rounding, and touch without
    overlapping. Raises `GeometryError` for outlines with too many crossings.
    """
    crossed = any(polygons.crossing_sides(outline) for outline in outlines)
    turned = [outline if polygons.area(outline) > 0 else outline[::-1] for outline in outlines]
    if not crossed and not _overlapping(turned):
        return turned
    sides = np.vstack([polygons.sides_of(outline) for outline in outlines])
    heights = np.unique(np.concatenate([sides[:, 1], _crossing_heights(sides)]))
    if len(heights) * len(sides) > MAX_SPLITS:
        msg = f"outlines of {len(sides)} sides have {len(heights)} heights of vertices and crossings: too many"
        raise GeometryError(msg)
    found = []
    for low, high in pairwise(heights):
        if high - low < 1e-9:
            continue
        x1, y1, x2, y2 = sides[
            (np.minimum(sides[:, 1], sides[:, 3]) <= low) & (np.maximum(sides[:, 1], sides[:, 3]) >= high)
        ].T
        slope = (x2 - x1) / (y2 - y1)
        below, above = x1 + (low - y1) * slope, x1 + (high - y1) * slope
        order = np.argsort(below + above, kind="stable")
        for left, right in zip(order[::2], order[1::2], strict=False):
            corners = np.array([(below[left], low), (below[right], low), (above[right], high), (above[left], high)])
            corners = corners[(np.abs(corners - np.roll(corners, 1, axis=0)) > 1e-9).any(axis=1)]
            if len(corners) >= 3 and polygons.area(corners) > 1e-12:
                found.append(corners)
    return found


def _crossing_heights(sides: Floats) -> Floats:
    """Return the heights at which sides cross one another."""
    rows = max(1, AT_ONCE // len(sides))
    found = [_crossed(sides[first : first + rows], sides) for first in range(0, len(sides), rows)]
    heights: Floats = np.concatenate(found)
    return heights


def _crossed(some: Floats, sides: Floats) -> Floats:
    """Return the heights at which some of the sides cross others."""
    begins, ways = some[:, :2], some[:, 2:] - some[:, :2]
    begin, way = sides[:, :2], sides[:, 2:] - sides[:, :2]
    slope = ways[:, None, 0] * way[None, :, 1] - ways[:, None, 1] * way[None, :, 0]
    gap = begin[None, :] - begins[:, None]
    meets = np.abs(slope) > 1e-15
    divisor = np.where(meets, slope, 1.0)
    along = (gap[..., 0] * way[None, :, 1] - gap[..., 1] * way[None, :, 0]) / divisor
    other = (gap[..., 0] * ways[:, None, 1] - gap[..., 1] * ways[:, None, 0]) / divisor
    hit = meets & (along > 0) & (along < 1) & (other > 0) & (other < 1)
    heights: Floats = (begins[:, None, 1] + along * ways[:, None, 1])[hit]
    return heights


def within(centres: Floats, half: float, sides: Floats) -> NDArray[np.bool_]:
    """Return which squares, with centres (n, 2) and sides of `2 half` [m], are crossed by one of `sides` (m, 4)."""
    hit = np.zeros(len(centres), dtype=bool)
    for x1, y1, x2, y2 in sides:
        enter, leave = np.zeros(len(centres)), np.ones(len(centres))
        miss = np.zeros(len(centres), dtype=bool)
        for begin, way, middle in ((x1, x2 - x1, centres[:, 0]), (y1, y2 - y1, centres[:, 1])):
            if way == 0:
                miss |= np.abs(begin - middle) >= half
                continue
            with np.errstate(over="ignore"):  # nearly parallel to the other axis
                a, b = (middle - half - begin) / way, (middle + half - begin) / way
            enter, leave = np.maximum(enter, np.minimum(a, b)), np.minimum(leave, np.maximum(a, b))
        hit |= ~miss & (enter < leave)
    return hit
