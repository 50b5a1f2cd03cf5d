"""Puts a scan on a map: GMapping's scan matcher.

The score of a pose is how near the ends of its beams are to the mean ends in the cells around them. A search goes
downhill from the odometry's pose, in steps that are halved when none is better (Grisetti et al., 2007, section IV; the
"vasco" matcher).

One defect of the original is not copied: it looks for the free cell before the end of a beam in a place that has
nothing to do with the beam (half the map away), so that this test passes nearly always.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.machine_code import machine_code
from rosmini.navigation.kernels import kernel

from .maps import SharedMaps

Floats = NDArray[np.float64]

MATCH = f"{__name__}:compiled_match"


class Matched(NamedTuple):
    """What a matcher found for each particle."""

    poses: Floats
    """(n, 3) of the laser."""
    scores: Floats
    """(n,): the sum over beams of how well each fits, from 0 to 1."""
    log_likelihoods: Floats
    """(n,)."""


@dataclass(frozen=True)
class Matcher:
    """The matcher's parameters, by their names at http://wiki.ros.org/gmapping#Parameters."""

    sigma: float = 0.05
    kernel_size: int = 1
    lstep: float = 0.05
    astep: float = 0.05
    iterations: int = 5
    lsigma: float = 0.075
    lskip: int = 0
    no_hit: float = -0.5
    """The log-likelihood of a beam that ends near nothing, before the division by `lsigma`."""

    def match(
        self, maps: SharedMaps, laser_poses: Floats, ranges: Floats, bearings: Floats, usable: float
    ) -> Matched:
        """Improve the pose of the laser (n, 3) on each particle's map.

        `ranges` (b,) [m] above `usable` and of 0 are left out.
        """
        chosen = (ranges > 0) & (ranges <= usable)
        if self.lskip:
            every = np.arange(len(ranges)) % (self.lskip + 1) == self.lskip
            chosen &= every
        ends, turns = np.ascontiguousarray(ranges[chosen]), np.ascontiguousarray(bearings[chosen])
        poses = np.ascontiguousarray(laser_poses, dtype=np.float64).copy()
        result = np.zeros((len(poses), 2))
        kernel(MATCH)(
            maps.tables,
            maps.means,
            maps.full,
            maps.low[0],
            maps.low[1],
            maps.resolution,
            poses,
            ends,
            np.cos(turns),
            np.sin(turns),
            self.kernel_size,
            self.sigma,
            self.lsigma,
            self.no_hit / self.lsigma,
            self.lstep,
            self.astep,
            self.iterations,
            result,
        )
        return Matched(poses, result[:, 0], result[:, 1])


FREE_RATIO = math.sqrt(2)
"""So many cells before the end of a beam the way has to be free."""


def fit(
    n: int,
    tables: Any,
    means: Any,
    full: Any,
    low_x: int,
    low_y: int,
    resolution: float,
    x: float,
    y: float,
    heading: float,
    ranges: Any,
    cosines: Any,
    sines: Any,
    size: int,
    sigma: float,
    lsigma: float,
    no_hit: float,
    least: float,
) -> tuple[float, float]:
    """Score and log-likelihood of a pose on the map of particle `n`.

    A score of no more than `least` is of no use: as soon as the beams that remain cannot lift it above, it is left.
    """
    rows, columns = tables.shape[1] * 32, tables.shape[2] * 32
    per_metre = 1.0 / resolution
    ahead_x, ahead_y = math.cos(heading), math.sin(heading)
    score = 0.0
    likelihood = 0.0
    for b in range(len(ranges)):
        if score + (len(ranges) - b) <= least:
            break
        cos = ahead_x * cosines[b] - ahead_y * sines[b]
        sin = ahead_y * cosines[b] + ahead_x * sines[b]
        end_x, end_y = x + ranges[b] * cos, y + ranges[b] * sin
        column, row = math.floor(end_x * per_metre) - low_x, math.floor(end_y * per_metre) - low_y
        before_x, before_y = math.floor(0.5 - FREE_RATIO * cos), math.floor(0.5 - FREE_RATIO * sin)
        best = -1.0
        for i in range(max(row - size, 0), min(row + size + 1, rows)):
            patch, block = -1, -1
            for j in range(max(column - size, 0), min(column + size + 1, columns)):
                if j >> 5 != block:
                    block = j >> 5
                    patch = tables[n, i >> 5, block]
                if patch < 0 or full[patch, i & 31, j & 31] == 0:
                    continue
                fi, fj = i + before_y, j + before_x
                if 0 <= fi < rows and 0 <= fj < columns:
                    free = tables[n, fi >> 5, fj >> 5]
                    if free >= 0 and full[free, fi & 31, fj & 31] == 1:
                        continue
                off_x = end_x - means[patch, i & 31, j & 31, 0]
                off_y = end_y - means[patch, i & 31, j & 31, 1]
                off = off_x * off_x + off_y * off_y
                if best < 0.0 or off < best:
                    best = off
        if best >= 0.0:
            score += math.exp(-best / sigma)
            likelihood -= best / lsigma
        else:
            likelihood += no_hit
    return score, likelihood


def match(
    tables: Any,
    means: Any,
    full: Any,
    low_x: int,
    low_y: int,
    resolution: float,
    poses: Any,
    ranges: Any,
    cosines: Any,
    sines: Any,
    size: int,
    sigma: float,
    lsigma: float,
    no_hit: float,
    lstep: float,
    astep: float,
    iterations: int,
    result: Any,
) -> None:
    """See `Matcher.match`: better poses into `poses`, score and log-likelihood into `result`."""
    for n in range(poses.shape[0]):
        x, y, heading = poses[n, 0], poses[n, 1], poses[n, 2]
        score, likelihood = fit(
            n,
            tables,
            means,
            full,
            low_x,
            low_y,
            resolution,
            x,
            y,
            heading,
            ranges,
            cosines,
            sines,
            size,
            sigma,
            lsigma,
            no_hit,
            -1.0,
        )
        step, turn, refined, before, last = lstep, astep, 0, -1.0, -1
        while score > before or refined < iterations:
            if before >= score:
                refined += 1
                step *= 0.5
                turn *= 0.5
                last = -1
            before = score
            from_x, from_y, from_heading = x, y, heading
            back, last = last, -1
            for move in range(6):
                if move == back:
                    continue  # it came from there
                sign = 1.0 if move % 2 == 0 else -1.0
                try_x = from_x + sign * step if move < 2 else from_x
                try_y = from_y + sign * step if 2 <= move < 4 else from_y
                try_heading = from_heading + sign * turn if move >= 4 else from_heading
                new, new_likelihood = fit(
                    n,
                    tables,
                    means,
                    full,
                    low_x,
                    low_y,
                    resolution,
                    try_x,
                    try_y,
                    try_heading,
                    ranges,
                    cosines,
                    sines,
                    size,
                    sigma,
                    lsigma,
                    no_hit,
                    score,
                )
                if new > score:
                    score, likelihood = new, new_likelihood
                    x, y, heading = try_x, try_y, try_heading
                    last = move ^ 1
        poses[n, 0], poses[n, 1], poses[n, 2] = x, y, heading
        result[n, 0], result[n, 1] = score, likelihood


@cache
def compiled_match() -> Callable[..., None]:
    """`match` as machine code, or as it is without numba."""
    try:
        from numba import float64, int32, int64, uint8, void
    except ImportError:
        return match
    number, count, beams = float64, int64, float64[::1]
    signature = void(
        int32[:, :, ::1],
        float64[:, :, :, ::1],
        uint8[:, :, ::1],
        count,
        count,
        number,
        float64[:, ::1],
        beams,
        beams,
        beams,
        count,
        number,
        number,
        number,
        number,
        number,
        count,
        float64[:, ::1],
    )
    return machine_code(match, signature, (fit,))
