"""Replacing staircases by long straight sides: closed outlines of cells, with few corners.

Douglas and Peucker's method (1973) works badly on staircases: it keeps each corner within some distance of a side,
and the staircase of a straight slanted wall has corners up to 0.7 cells away from it. Here a side may replace a part
of the outline if it passes between the same cells: all centres on its left stay on its left, those on its right on
its right, none closer than a margin. Sides connect corners of cells or middles of steps; the best choice is
found by trying all of them, as Imai and Iri (1988) do, and Selinger's potrace (2003) for pictures.

Only monotone parts, which use two of the four directions, can be straightened. For them the centres next to
their edges are sufficient: every other centre lies behind one of these. The directions of the lines from one place
between all centres so far form an interval, so each further place costs a few comparisons.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

REACH = 500
"""Maximum number of places that a side may skip.

Longer sides are split, so that the work is proportional to the size of the outline and not to its square.
"""

_SLACK = 1e-9  # tolerance of an angle [rad]
# A side costs 1, plus this factor times the squared distance of each place that it skips [cells]: little, but it
# chooses the closest of the solutions with equally many sides.
_SQUARES = 0.05


@dataclass(frozen=True)
class _Places:
    """Candidates for corners, loop after loop: corners of the cells, and middles of steps of one cell."""

    points: Floats
    is_corner: NDArray[np.bool_]
    loop: Ints
    """The loop of each place."""
    first: Ints
    """The first place of each loop."""
    size: Ints
    """Number of places in each loop."""


@dataclass(frozen=True)
class _Sides:
    """Possible sides: from index `start` over `skip` indices, with the sum of squared distances [cells2]."""

    start: Ints
    skip: Ints
    squares: Floats


def straightened(loops: list[Ints], tolerance: float) -> list[Floats]:
    """Return the loops, each the corners (k, 2) of a closed outline with the inside on its left, with few corners.

    No centre of a cell is closer to a side than half a cell minus `tolerance` [cells], which is in [0, 0.5).
    Corners of the result are corners of the outline or middles of its single steps. The result has the lowest cost
    of all choices: 1 for each side, plus a little for its deviation from the edges. A loop is opened at the place
    that the fewest possible sides skip; if no side skips it, the result is still optimal.
    """
    if not loops:
        return []
    places = _places(loops)
    sides = _possible_sides(places, 0.5 - tolerance)
    return _shortest(places, sides, _anchors(places, sides))


def _places(loops: list[Ints]) -> _Places:
    points, corner, sizes = [], [], []
    for loop in loops:
        ways = np.roll(loop, -1, axis=0) - loop
        before = np.roll(ways, 1, axis=0)
        left = before[:, 0] * ways[:, 1] > before[:, 1] * ways[:, 0]
        step = (np.abs(ways).sum(axis=1) == 1) & (left != np.roll(left, -1))
        order = np.argsort(np.concatenate([np.arange(len(loop)), np.flatnonzero(step) + 0.5]), kind="stable")
        points.append(np.concatenate([loop, (loop + ways / 2)[step]])[order])
        corner.append(order < len(loop))
        sizes.append(len(order))
    size = np.array(sizes, dtype=np.intp)
    return _Places(
        np.concatenate(points),
        np.concatenate(corner),
        np.repeat(np.arange(len(loops)), size),
        np.concatenate([[0], np.cumsum(size)[:-1]]),
        size,
    )


def _possible_sides(places: _Places, margin: float) -> _Sides:
    """Find all sides that keep the margin, for all starts at once, place by place along the loops."""
    points = places.points
    alive = np.arange(len(points))
    last = alive.copy()
    way = np.zeros(len(points))
    ahead = np.zeros_like(points)  # the direction of the first step
    low, high = np.full(len(points), -np.inf), np.full(len(points), np.inf)
    xx, xy, yy = (np.zeros(len(points)) for _ in range(3))
    found: list[tuple[Ints, int, Floats]] = []
    for skip in range(1, REACH + 1):
        loop = places.loop[alive]
        first, size = places.first[loop], places.size[loop]
        here = first + (alive - first + skip) % size
        part = points[here] - points[last[alive]]
        length = np.abs(part).sum(axis=1)
        way[alive] += length
        v = points[here] - points[alive]
        climbs = np.abs(v).sum(axis=1) > way[alive] - 0.25  # it never turned back; lengths are multiples of a half
        keep = climbs & (skip < size)
        alive, here, v, e = alive[keep], here[keep], v[keep], (part / length[:, None])[keep]
        if skip == 1:
            ahead[alive] = e
        u = ahead[alive]
        for edge in (
            points[last[alive]] + 0.5 * e * places.is_corner[last[alive], None],
            points[here] - 0.5 * e * places.is_corner[here, None],
        ):
            beside = edge - points[alive]
            normal = 0.5 * np.stack([-e[:, 1], e[:, 0]], axis=1)
            on_left, on_right = beside + normal, beside - normal
            high[alive] = np.minimum(high[alive], _angle(u, on_left) - _room(on_left, margin))
            low[alive] = np.maximum(low[alive], _angle(u, on_right) + _room(on_right, margin))
        last[alive] = here
        keep = low[alive] <= high[alive] + _SLACK
        alive, v, u = alive[keep], v[keep], u[keep]
        if not len(alive):
            break
        angle = _angle(u, v)
        fits = (low[alive] - _SLACK <= angle) & (angle <= high[alive] + _SLACK)
        x, y = v.T
        squares = (x**2 * yy[alive] - 2 * x * y * xy[alive] + y**2 * xx[alive]) / (x**2 + y**2)
        found.append((alive[fits], skip, np.maximum(squares[fits], 0.0)))
        xx[alive] += x**2
        xy[alive] += x * y
        yy[alive] += y**2
    return _Sides(
        np.concatenate([start for start, _, _ in found]),
        np.concatenate([np.full(len(start), skip) for start, skip, _ in found]),
        np.concatenate([squares for _, _, squares in found]),
    )


def _angle(u: Floats, v: Floats) -> Floats:
    """Return the angles from each of `u` to each of `v` [rad]."""
    angles: Floats = np.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
    return angles


def _room(centres: Floats, margin: float) -> Floats:
    """Return half the angle that a disc of radius `margin` around each of the centres covers [rad].

    All centres are at least half a cell away.
    """
    halves: Floats = np.arcsin(np.minimum(margin / np.hypot(centres[:, 0], centres[:, 1]), 1.0))
    return halves


def _anchors(places: _Places, sides: _Sides) -> Ints:
    """Return the place of each loop that the fewest sides skip, preferably a corner.

    Places are counted from the first one of the loop.
    """
    loop = places.loop[sides.start]
    base = places.first[loop] + loop  # one more slot per loop, for sides that end behind its last place
    size = places.size[loop]
    begin = sides.start - places.first[loop] + 1
    end = begin + sides.skip - 1
    slots = len(places.points) + len(places.first)

    def count(where: Ints) -> Ints:
        return np.bincount(where, minlength=slots)

    wraps = end > size
    change = count(base + np.minimum(begin, size)) - count(base + np.minimum(end, size))
    change += count(base[wraps]) - count(base[wraps] + end[wraps] - size[wraps])
    skipped = np.cumsum(change)
    slot = np.arange(len(places.points)) + places.loop
    rank = 2 * skipped[slot] - places.is_corner
    return np.array(
        [rank[first : first + size].argmin() for first, size in zip(places.first, places.size, strict=True)]
    )


def _shortest(places: _Places, sides: _Sides, anchors: Ints) -> list[Floats]:
    """Return the cheapest sequence of sides around each loop, from its anchor back to its anchor."""
    loop = places.loop[sides.start]
    begin = (sides.start - places.first[loop] - anchors[loop]) % places.size[loop]
    inside = begin + sides.skip <= places.size[loop]
    base = places.first + np.arange(
        len(places.first)
    )  # each loop has one node more than places: its anchor appears twice
    starts = (base[loop] + begin)[inside]
    ends = starts + sides.skip[inside]
    order = np.argsort(ends, kind="stable")
    costs = 1.0 + _SQUARES * sides.squares[inside]
    total = [float("inf")] * (len(places.points) + len(places.first))
    before = [-1] * len(total)
    for node in base.tolist():
        total[node] = 0.0
    for start, end, cost in zip(starts[order].tolist(), ends[order].tolist(), costs[order].tolist(), strict=True):
        if total[start] + cost < total[end]:
            total[end] = total[start] + cost
            before[end] = start
    outlines = []
    for first, size, anchor, node in zip(places.first, places.size, anchors, base, strict=True):
        way = []
        at = before[node + size]
        while at >= 0:
            way.append(at - node)
            at = before[at]
        outlines.append(places.points[first + (np.array(way[::-1]) + anchor) % size])
    return outlines
