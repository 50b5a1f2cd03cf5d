"""Raycasting with numpy: find candidate pairs of ray and object, then test all pairs at once.

Seen from the sensor, a segment or disc covers a sector of directions. Only the rays in its sector are tested,
some thousand pairs instead of segments times rays. `rosmini.sim.geometry.raycast_numba` does the same with loops;
the comments on geometry here apply to both.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .raycast_numba import FLAT, MARGIN, NEAR, SLACK, TURN

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Origins = tuple[Floats, Floats, float, float]
"""Origins of the rays relative to the sensor, their greatest distance, and the unevenness of the angles."""

BLOCK = 1 << 19
"""Number of pairs tested at once, which limits the memory needed for a large world."""


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
    """Lower `ranges` (count,) to the distance of the nearest object on each ray within `max_range`.

    Ray i starts at (x + dx[i], y + dy[i]), at most `away` from (x, y), in direction (cos[i], sin[i]), which is the
    angle `first + i * step` up to an error of `spread`; `step` is not negative. Segment k is seen by the rays from
    segment_rays[k, 0] to segment_rays[k, 1], exclusive, and likewise for disc k; if these arrays have no rows, all
    rays see all objects.
    """
    origins = (dx, dy, away, spread)
    cast_segments(segments - (x, y, x, y), cos, sin, first, step, max_range, ranges, origins, segment_rays)
    cast_discs(discs - (x, y, 0.0), cos, sin, first, step, max_range, ranges, origins, disc_rays)


def cast_segments(
    segments: Floats,
    cos: Floats,
    sin: Floats,
    first: float,
    step: float,
    max_range: float,
    ranges: Floats,
    origins: Origins,
    rays: Ints,
) -> None:
    """Do `cast` for segments relative to the sensor."""
    dx, dy, away, spread = origins
    distances = _distances(segments)
    within = distances <= max_range + SLACK + away
    segments, distances = segments[within], distances[within]
    x1, y1, x2, y2 = segments.T
    sweeps = np.arctan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2)
    near = distances < NEAR + 2 * away
    more = spread + np.arcsin(np.where(near, 0.0, away / np.maximum(distances, NEAR)))
    starts = np.arctan2(y1, x1) + np.minimum(sweeps, 0) - more
    own = rays[within] if len(rays) else rays
    for which, ray in _pairs(starts, np.abs(sweeps) + 2 * more, near, first, step, len(ranges), own):
        c, s = cos[ray], sin[ray]
        px, py, qx, qy = segments[which].T - np.stack([dx[ray], dy[ray], dx[ray], dy[ray]])
        # Offsets of the ends to the left of the ray, and ahead of the sensor. A common end of two segments gets the
        # same numbers in both, so no ray slips between them.
        k1, k2 = c * py - s * px, c * qy - s * qx
        a1, a2 = c * px + s * py, c * qx + s * qy
        touched = (np.minimum(k1, k2) <= SLACK) & (np.maximum(k1, k2) >= -SLACK)
        along = (np.abs(k1) <= SLACK) & (np.abs(k2) <= SLACK)
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.minimum(np.maximum(k1 / (k1 - k2), 0.0), 1.0)
        ahead = np.where(along, np.minimum(a1, a2), a1 + part * (a2 - a1))
        last = np.where(along, np.maximum(a1, a2), ahead)
        ahead = np.where(ahead > 0.0, ahead, 0.0)
        met = touched & (last >= -SLACK) & (ahead <= max_range)
        np.minimum.at(ranges, ray[met], ahead[met])


def cast_discs(
    discs: Floats,
    cos: Floats,
    sin: Floats,
    first: float,
    step: float,
    max_range: float,
    ranges: Floats,
    origins: Origins,
    rays: Ints,
) -> None:
    """Do `cast` for discs relative to the sensor."""
    dx, dy, away, spread = origins
    distances = np.sqrt(discs[:, 0] * discs[:, 0] + discs[:, 1] * discs[:, 1])
    gaps = distances - discs[:, 2]
    within = gaps <= max_range + 2 * SLACK + away
    discs, distances, gaps = discs[within], distances[within], gaps[within]
    near = (distances < NEAR) | (gaps < 2 * away) | (gaps <= 2 * SLACK + away)
    safe = np.where(near, 1.0, distances)
    halves = np.arcsin(np.where(near, 0.0, discs[:, 2] / safe)) + spread
    halves += np.arcsin(np.where(near, 0.0, away / np.where(near, 1.0, gaps)))
    starts = np.arctan2(discs[:, 1], discs[:, 0]) - halves
    own = rays[within] if len(rays) else rays
    for which, ray in _pairs(starts, 2 * halves, near, first, step, len(ranges), own):
        c, s = cos[ray], sin[ray]
        px, py, radius = discs[which].T - np.stack([dx[ray], dy[ray], np.zeros(len(ray))])
        inside = np.sqrt(px * px + py * py) - radius <= SLACK
        aside, ahead = np.abs(c * py - s * px), c * px + s * py
        half_chord = np.sqrt(np.maximum((radius - aside) * (radius + aside), 0.0))
        entry = np.where(inside, 0.0, ahead - half_chord)
        met = inside | ((aside <= radius) & (ahead > 0) & (entry <= max_range))
        np.minimum.at(ranges, ray[met], np.where(entry > 0.0, entry, 0.0)[met])


def _distances(segments: Floats) -> Floats:
    """Return the distances from the origin to the nearest point of each segment (n,)."""
    x1, y1, x2, y2 = segments.T
    ex, ey = x2 - x1, y2 - y1
    squares = ex * ex + ey * ey
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(squares > 0, -(x1 * ex + y1 * ey) / squares, 0.0)
    part = np.minimum(np.maximum(part, 0.0), 1.0)
    px, py = x1 + part * ex, y1 + part * ey
    nearest: Floats = np.sqrt(px * px + py * py)
    return nearest


def _pairs(
    starts: Floats, widths: Floats, near: NDArray[np.bool_], first: float, step: float, count: int, rays: Ints
) -> Iterator[tuple[Ints, Ints]]:
    """Yield pairs of a sector and a ray in it, as two arrays of indices.

    The sectors extend from `starts` counter-clockwise by `widths`; rays that cover more than one turn pass each sector
    more than once. Sectors that are `near` are paired with every ray; if `rays` (n, 2) has rows, each sector only with
    the rays in its range.
    """
    turns = int(step * (count - 1) // TURN) + 2
    pitch = max(step, FLAT)
    everywhere = near | (step < FLAT)
    begins = starts - MARGIN - first
    begins = np.where(everywhere, 0.0, begins - TURN * (np.floor(begins / TURN) + 1))
    begins = begins[:, None] + TURN * np.arange(turns)
    ends = begins + np.where(everywhere, np.inf, widths + 2 * MARGIN)[:, None]
    least, most = (rays[:, :1], rays[:, 1:] - 1.0) if len(rays) else (0.0, count - 1.0)
    low = np.maximum(np.ceil(begins / pitch), least).ravel()
    high = np.minimum(np.floor(ends / pitch), most).ravel()
    lengths = np.maximum(high - low + 1, 0.0).astype(np.intp)
    upto = np.cumsum(lengths)
    total = int(upto[-1]) if len(upto) else 0
    cuts = [0, *np.searchsorted(upto, np.arange(BLOCK, total, BLOCK)).tolist(), len(upto)]
    for begin, end in itertools.pairwise(cuts):
        size = lengths[begin:end]
        sectors = np.repeat(np.arange(begin, end) // turns, size)
        shifts = low[begin:end].astype(np.int64) - (np.cumsum(size) - size)
        yield sectors, np.arange(len(sectors)) + np.repeat(shifts, size)
