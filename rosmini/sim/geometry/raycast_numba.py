"""Raycasting with numba: the loops of `rosmini.sim.geometry.raycast_numpy`, which explains the geometry.

The functions here are plain Python. `compiled` compiles them, the first time in about a second, later
from numba's cache. Only scalars, explicit types and no slices keep that second from becoming ten.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.machine_code import machine_code

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# These constants are compiled in, and numba's cache checks only whether this file has changed.
TURN = 2 * math.pi

SLACK = 1e-9
"""Tolerance at the ends of segments, and for a sensor on a wall [m]."""

NEAR = 1e-3
"""A closer segment is tested with every ray [m]: with `SLACK` added, its sector is too wide to be useful."""

MARGIN = 1e-5
"""Added to both sides of a sector [rad]: more than `SLACK` at distance `NEAR`, and more than rounding errors."""

FLAT = 1e-9
"""If rays are closer together than this, each object is tested with all rays [rad]."""


def cast(
    segments: Floats,
    discs: Floats,
    x: float,
    y: float,
    cos: Floats,
    sin: Floats,
    first: float,
    step: float,
    max_range: float,
    ranges: Floats,
    dx: Floats,
    dy: Floats,
    away: float,
    spread: float,
    segment_rays: Ints,
    disc_rays: Ints,
) -> None:
    """Do the same as `rosmini.sim.geometry.raycast_numpy.cast`."""
    low, high = 0, len(ranges)
    for n in range(segments.shape[0]):
        if segment_rays.shape[0]:
            low, high = segment_rays[n, 0], segment_rays[n, 1]
        x1, y1 = segments[n, 0] - x, segments[n, 1] - y
        x2, y2 = segments[n, 2] - x, segments[n, 3] - y
        cast_segment(x1, y1, x2, y2, cos, sin, first, step, max_range, ranges, dx, dy, away, spread, low, high)
    low, high = 0, len(ranges)
    for n in range(discs.shape[0]):
        if disc_rays.shape[0]:
            low, high = disc_rays[n, 0], disc_rays[n, 1]
        px, py, radius = discs[n, 0] - x, discs[n, 1] - y, discs[n, 2]
        cast_disc(px, py, radius, cos, sin, first, step, max_range, ranges, dx, dy, away, spread, low, high)


def cast_segment(
    x1: float,
    y1: float,
    x2: float,
    y2: float,
    cos: Floats,
    sin: Floats,
    first: float,
    step: float,
    max_range: float,
    ranges: Floats,
    dx: Floats,
    dy: Floats,
    away: float,
    spread: float,
    low: int,
    high: int,
) -> None:
    """Do `cast` for one segment relative to the sensor, and for the rays from `low` to `high`, exclusive."""
    far = max_range + SLACK + away
    if max(x1, x2) < -far or min(x1, x2) > far or max(y1, y2) < -far or min(y1, y2) > far:
        return
    distance = segment_distance(x1, y1, x2, y2)
    if distance > far:
        return
    begin, width = 0.0, math.inf
    if distance >= NEAR + 2 * away and step >= FLAT:
        more = spread + math.asin(away / distance)
        sweep = math.atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)
        begin = before(math.atan2(y1, x1) + min(sweep, 0.0) - more, first)
        width = abs(sweep) + 2 * (MARGIN + more)
    pitch, last = max(step, FLAT), len(ranges) - 1
    while begin <= step * last:
        for i in range(max(math.ceil(begin / pitch), low), int(min((begin + width) / pitch, high - 1)) + 1):
            met = meet_segment(x1 - dx[i], y1 - dy[i], x2 - dx[i], y2 - dy[i], cos[i], sin[i])
            if met < ranges[i] and met <= max_range:
                ranges[i] = met
        begin += TURN


def cast_disc(
    x: float,
    y: float,
    radius: float,
    cos: Floats,
    sin: Floats,
    first: float,
    step: float,
    max_range: float,
    ranges: Floats,
    dx: Floats,
    dy: Floats,
    away: float,
    spread: float,
    low: int,
    high: int,
) -> None:
    """Do `cast` for one disc relative to the sensor, and for the rays from `low` to `high`, exclusive."""
    distance = math.sqrt(x * x + y * y)
    gap = distance - radius
    if gap <= 2 * SLACK + away:
        for i in range(low, high):
            px, py = x - dx[i], y - dy[i]
            if math.sqrt(px * px + py * py) - radius <= SLACK:
                ranges[i] = 0.0
    if gap > max_range + 2 * SLACK + away:
        return
    begin, width = 0.0, math.inf
    if distance >= NEAR and gap >= 2 * away and step >= FLAT:
        half = math.asin(radius / distance) + spread
        if away > 0.0:
            half += math.asin(away / gap)
        begin, width = before(math.atan2(y, x) - half, first), 2 * half + 2 * MARGIN
    pitch, last = max(step, FLAT), len(ranges) - 1
    while begin <= step * last:
        for i in range(max(math.ceil(begin / pitch), low), int(min((begin + width) / pitch, high - 1)) + 1):
            met = meet_disc(x - dx[i], y - dy[i], radius, cos[i], sin[i])
            if met < ranges[i] and met <= max_range:
                ranges[i] = met
        begin += TURN


def before(start: float, first: float) -> float:
    """Return the start of a sector relative to the first ray, as an angle in the turn before that ray."""
    begin = start - MARGIN - first
    return begin - TURN * (math.floor(begin / TURN) + 1)


def segment_distance(x1: float, y1: float, x2: float, y2: float) -> float:
    """Return the distance from the sensor to the nearest point of a segment."""
    ex, ey = x2 - x1, y2 - y1
    square = ex * ex + ey * ey
    part = min(max(-(x1 * ex + y1 * ey) / square, 0.0), 1.0) if square > 0 else 0.0
    px, py = x1 + part * ex, y1 + part * ey
    return math.sqrt(px * px + py * py)


def meet_segment(x1: float, y1: float, x2: float, y2: float, c: float, s: float) -> float:
    """Return the distance along a ray in direction (c, s) to a segment, or inf."""
    k1, k2 = c * y1 - s * x1, c * y2 - s * x2
    if min(k1, k2) > SLACK or max(k1, k2) < -SLACK:
        return math.inf
    a1, a2 = c * x1 + s * y1, c * x2 + s * y2
    if max(abs(k1), abs(k2)) <= SLACK:
        return positive(min(a1, a2)) if max(a1, a2) >= -SLACK else math.inf
    ahead = a1 + min(max(k1 / (k1 - k2), 0.0), 1.0) * (a2 - a1)
    return positive(ahead) if ahead >= -SLACK else math.inf


def meet_disc(x: float, y: float, radius: float, c: float, s: float) -> float:
    """Return the distance along a ray in direction (c, s) to a disc that does not contain the sensor, or inf."""
    aside, ahead = abs(c * y - s * x), c * x + s * y
    if aside > radius or ahead <= 0:
        return math.inf
    return positive(ahead - math.sqrt((radius - aside) * (radius + aside)))


def positive(number: float) -> float:
    """Return a number, or 0.0 if it is negative or -0.0."""
    return max(0.0, number)


HELPERS = (cast_segment, cast_disc, before, segment_distance, meet_segment, meet_disc, positive)
"""The functions that `cast` calls."""


@cache
def compiled() -> Callable[..., None]:
    """Return `cast` compiled by numba. Raises `ImportError` without numba."""

    def signature(numba: Any) -> Any:
        number = numba.float64
        table = numba.types.Array(number, 2, "C", readonly=True)
        read = numba.types.Array(number, 1, "C", readonly=True)
        rays = numba.types.Array(numba.int64, 2, "C", readonly=True)
        plain = (table, table, number, number, read, read, number, number, number, number[::1])
        return numba.void(*plain, read, read, number, number, rays, rays)

    return machine_code(cast, signature, HELPERS)
