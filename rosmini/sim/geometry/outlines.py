"""Distance and contact points of two convex outlines. Loops for `rosmini.sim.engine.kernels`.

An outline has a radius around it: one corner with a radius is a disc, two corners without one are a wall. The
depth of an overlap is the shortest motion that separates two outlines, along the normal of one of their sides
(separating axis theorem: Gottschalk, Lin and Manocha, SIGGRAPH 1996). The contact points lie on the two sides
that face each other.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

Contact = tuple[int, float, float, float, float, float, float, float, float]
"""Number of points, the normal (x, y), and for each point its depth and position (depth, x, y) [m]."""

NONE: Contact = (0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def parting(a: Floats, a0: int, a1: int, b: Floats, b0: int, b1: int, most: float) -> tuple[float, float, float]:
    """Return the largest separation along a normal of the first outline, and that normal; stops above `most`."""
    best, nx, ny = -math.inf, 0.0, 0.0
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        length = math.sqrt(ex * ex + ey * ey)
        if length == 0.0:
            continue
        ux, uy = ey / length, -ex / length
        least = math.inf
        for m in range(b0, b1):
            least = min(least, (b[m, 0] - a[k, 0]) * ux + (b[m, 1] - a[k, 1]) * uy)
        if least > best:
            best, nx, ny = least, ux, uy
            if best > most:
                break
    return best, nx, ny


def facing(a: Floats, a0: int, a1: int, nx: float, ny: float) -> tuple[int, int]:
    """Return the corners of the side that best faces a normal, of the two sides at the corner farthest along it."""
    far, i = -math.inf, a0
    for k in range(a0, a1):
        along = a[k, 0] * nx + a[k, 1] * ny
        if along > far:
            far, i = along, k
    before, after = (i - 1 if i > a0 else a1 - 1), (i + 1 if i + 1 < a1 else a0)
    ex, ey = a[i, 0] - a[before, 0], a[i, 1] - a[before, 1]
    fx, fy = a[after, 0] - a[i, 0], a[after, 1] - a[i, 1]
    e, f = math.sqrt(ex * ex + ey * ey), math.sqrt(fx * fx + fy * fy)
    if (ey * nx - ex * ny) * f > (fy * nx - fx * ny) * e:
        return before, i
    return i, after


def height(a: Floats, i: int, j: int, nx: float, ny: float, t: float) -> float:
    """Return the coordinate along a normal of the point of a side at coordinate `t` along the tangent [m].

    The tangent is the normal turned left by 90 degrees. For a side parallel to the normal, return the larger
    coordinate of its ends.
    """
    ti, tj = a[i, 1] * nx - a[i, 0] * ny, a[j, 1] * nx - a[j, 0] * ny
    hi, hj = a[i, 0] * nx + a[i, 1] * ny, a[j, 0] * nx + a[j, 1] * ny
    if abs(tj - ti) < 1e-12:
        return float(max(hi, hj))
    part = (t - ti) / (tj - ti)
    return float(hi + part * (hj - hi))


def contact(a: Floats, a0: int, a1: int, ra: float, b: Floats, b0: int, b1: int, rb: float, least: float) -> Contact:
    """Return the points and depth of an overlap above `least`; the normal points from the first to the second."""
    if b1 - b0 == 1:
        return contact_disc(a, a0, a1, ra, b[b0, 0], b[b0, 1], rb, least)
    if a1 - a0 == 1:
        count, nx, ny, depth, x, y, _, _, _ = contact_disc(b, b0, b1, rb, a[a0, 0], a[a0, 1], ra, least)
        return count, -nx, -ny, depth, x, y, 0.0, 0.0, 0.0
    apart, nx, ny = parting(a, a0, a1, b, b0, b1, -least)
    if apart >= -least:
        return NONE
    other, mx, my = parting(b, b0, b1, a, a0, a1, -least)
    if other > apart:
        apart, nx, ny = other, -mx, -my
        if apart >= -least:
            return NONE
    i, j = facing(a, a0, a1, nx, ny)
    p, q = facing(b, b0, b1, -nx, -ny)
    ti, tj = a[i, 1] * nx - a[i, 0] * ny, a[j, 1] * nx - a[j, 0] * ny
    tp, tq = b[p, 1] * nx - b[p, 0] * ny, b[q, 1] * nx - b[q, 0] * ny
    begin, end = max(min(ti, tj), min(tp, tq)), min(max(ti, tj), max(tp, tq))
    if begin > end:  # because of rounding
        begin = end = (begin + end) / 2
    h, k = height(a, i, j, nx, ny, begin), height(a, i, j, nx, ny, end)
    depth, deep = h - height(b, p, q, nx, ny, begin), k - height(b, p, q, nx, ny, end)
    x, y, u, v = h * nx - begin * ny, h * ny + begin * nx, k * nx - end * ny, k * ny + end * nx
    lowest = min(least, 0.0)
    if depth < lowest and deep < lowest:
        return 1, nx, ny, -apart, x, y, 0.0, 0.0, 0.0
    if deep < lowest:
        return 1, nx, ny, depth, x, y, 0.0, 0.0, 0.0
    if depth < lowest:
        return 1, nx, ny, deep, u, v, 0.0, 0.0, 0.0
    return 2, nx, ny, depth, x, y, deep, u, v


def nearest_side(a: Floats, a0: int, a1: int, x: float, y: float) -> tuple[float, float, float]:
    """Return the squared distance of a point from an outline's sides, and the nearest point on them."""
    best, px, py = math.inf, 0.0, 0.0
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        square = ex * ex + ey * ey
        t = 0.0
        if square > 0.0:
            t = min(1.0, max(0.0, ((x - a[k, 0]) * ex + (y - a[k, 1]) * ey) / square))
        qx, qy = a[k, 0] + t * ex, a[k, 1] + t * ey
        away = (x - qx) * (x - qx) + (y - qy) * (y - qy)
        if away < best:
            best, px, py = away, qx, qy
    return best, px, py


def contact_disc(a: Floats, a0: int, a1: int, ra: float, x: float, y: float, radius: float, least: float) -> Contact:
    """`contact` of an outline with a disc."""
    out, nx, ny = -math.inf, 1.0, 0.0  # distance of the centre from the side that it is farthest outside of
    for k in range(a0, a1):
        j = k + 1 if k + 1 < a1 else a0
        ex, ey = a[j, 0] - a[k, 0], a[j, 1] - a[k, 1]
        length = math.sqrt(ex * ex + ey * ey)
        if length > 0.0:
            far = ((x - a[k, 0]) * ey - (y - a[k, 1]) * ex) / length
            if far > out:
                out, nx, ny = far, ey / length, -ex / length
    if radius + ra - out <= least:
        return NONE
    if -math.inf < out <= 0.0:
        return 1, nx, ny, radius - out, x - out * nx, y - out * ny, 0.0, 0.0, 0.0
    square, px, py = nearest_side(a, a0, a1, x, y)
    away = math.sqrt(square)
    depth = radius + ra - away
    if depth <= least:
        return NONE
    if away > 0.0:
        nx, ny = (x - px) / away, (y - py) / away
    return 1, nx, ny, depth, px + ra * nx, py + ra * ny, 0.0, 0.0, 0.0


def gap(a: Floats, a0: int, a1: int, ra: float, b: Floats, b0: int, b1: int, rb: float) -> float:
    """Return the distance of two outlines; negative if they overlap."""
    apart, _, _ = parting(a, a0, a1, b, b0, b1, math.inf)
    if b1 - b0 > 1:
        other, _, _ = parting(b, b0, b1, a, a0, a1, math.inf)
        apart = max(apart, other)
    if -math.inf < apart <= 0.0:
        return apart - ra - rb
    best = math.inf
    for m in range(b0, b1):
        away, _, _ = nearest_side(a, a0, a1, b[m, 0], b[m, 1])
        best = min(best, away)
    if b1 - b0 > 1:
        for k in range(a0, a1):
            away, _, _ = nearest_side(b, b0, b1, a[k, 0], a[k, 1])
            best = min(best, away)
    return math.sqrt(best) - ra - rb
