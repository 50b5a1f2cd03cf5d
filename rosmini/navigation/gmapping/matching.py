"""Matching of a scan with a map: GMapping's scan matcher.

The score of a pose depends on the distances from its beam ends to the mean ends in the surrounding cells. A search
climbs from the odometry's pose, in steps that are halved when none improves the score (Grisetti et al., 2007, section
IV; the "vasco" matcher).

One defect of the original is not copied: it looks for the free cell before the end of a beam in an unrelated place,
half the map away, so that this test nearly always passes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.navigation.kernels import kernel

from .maps import SharedMaps

Floats = NDArray[np.float64]


class Matched(NamedTuple):
    """The result of matching for each particle."""

    poses: Floats
    """Laser poses (n, 3): the best ones found, or the given one where the best one's score is too low."""
    scores: Floats
    """Best scores found (n,): the sum over all beams of their fits, each from 0 to 1."""
    log_likelihoods: Floats
    """Log-likelihoods (n,) of `poses`."""


class Grids(NamedTuple):
    """The arrays of `SharedMaps` that a matcher reads."""

    tables: Any
    means: Any
    full: Any
    low_x: int
    low_y: int
    resolution: float


class Beams(NamedTuple):
    """The b beams that are matched."""

    ranges: Any
    cosines: Any
    sines: Any
    """Cosines and sines of the bearings (b,)."""
    ends: Any
    """Beam ends relative to the laser along the map's axes (b, 2) [m]; written by `aim`."""
    before: Any
    """Offsets to the cell before the end, which must be free (b, 2) [cells]; written by `aim`."""


class Rule(NamedTuple):
    """Parameters of scoring and of the search."""

    size: int
    sigma: float
    lsigma: float
    no_hit: float
    lstep: float
    astep: float
    iterations: int


@dataclass(frozen=True)
class Matcher:
    """A scan matcher; its parameters are named as in http://wiki.ros.org/gmapping#Parameters."""

    sigma: float = 0.05
    kernel_size: int = 1
    lstep: float = 0.05
    astep: float = 0.05
    iterations: int = 5
    lsigma: float = 0.075
    lskip: int = 0
    minimum_score: float = -1.0
    """A pose with at most this score is rejected; -1 accepts all."""
    no_hit: float = -0.5
    """Log-likelihood of a beam without an end nearby, before the division by `lsigma`."""

    def match(self, maps: SharedMaps, laser_poses: Floats, ranges: Floats, bearings: Floats, usable: float) -> Matched:
        """Return better laser poses, near the given ones (n, 3), on the map of each particle.

        `ranges` (b,) [m] of 0 and above `usable` are ignored.
        """
        poses = np.ascontiguousarray(laser_poses, dtype=np.float64).copy()
        result = np.zeros((len(poses), 2))
        compiled_match()(
            grids_of(maps), self.beams(ranges, bearings, usable), self.rule, self.minimum_score, poses, result
        )
        return Matched(poses, result[:, 0], result[:, 1])

    def score(self, maps: SharedMaps, laser_poses: Floats, ranges: Floats, bearings: Floats, usable: float) -> Matched:
        """Return the scores of the given poses (n, 3), without improving the poses."""
        still = replace(self, lstep=0.0, astep=0.0, iterations=0)
        return still.match(maps, laser_poses, ranges, bearings, usable)

    def beams(self, ranges: Floats, bearings: Floats, usable: float) -> Beams:
        """Return the beams used in scan matching: those with ranges in (0, `usable`] [m].

        With `lskip`, only every (`lskip` + 1)th beam of the scan is considered.
        """
        chosen = (ranges > 0) & (ranges <= usable)
        if self.lskip:
            chosen &= np.arange(len(ranges)) % (self.lskip + 1) == self.lskip
        turns, count = bearings[chosen], int(chosen.sum())
        return Beams(
            np.ascontiguousarray(ranges[chosen]),
            np.cos(turns),
            np.sin(turns),
            np.zeros((count, 2)),
            np.zeros((count, 2), np.int64),
        )

    @property
    def rule(self) -> Rule:
        """The parameters in the form that the loops need."""
        return Rule(
            self.kernel_size,
            self.sigma,
            self.lsigma,
            self.no_hit / self.lsigma,
            self.lstep,
            self.astep,
            self.iterations,
        )


def grids_of(maps: SharedMaps) -> Grids:
    """Return the current arrays of `maps`."""
    return Grids(maps.tables, maps.means, maps.full, *maps.low, maps.resolution)


NO_END = 1e300
"""Squared distance of a beam end without another end nearby."""
FREE_CELL_DISTANCE = math.sqrt(2)
"""Distance [cells] before the end of a beam at which the cell must be free."""


def aim(heading: float, beams: Any) -> None:
    """Write the beam ends, and the offsets to the cells before them, for a laser's heading [rad] into `beams`."""
    ahead_x, ahead_y = math.cos(heading), math.sin(heading)
    for b in range(len(beams.ranges)):
        cos = ahead_x * beams.cosines[b] - ahead_y * beams.sines[b]
        sin = ahead_y * beams.cosines[b] + ahead_x * beams.sines[b]
        beams.ends[b, 0], beams.ends[b, 1] = beams.ranges[b] * cos, beams.ranges[b] * sin
        beams.before[b, 0] = math.floor(0.5 - FREE_CELL_DISTANCE * cos)
        beams.before[b, 1] = math.floor(0.5 - FREE_CELL_DISTANCE * sin)


def window(n: int, row: int, west: int, east: int, tables: Any, full: Any) -> int:
    """Return the bits of full cells in a row of particle `n`'s map, from column `west` on."""
    here, there = tables[n, row >> 5, west >> 5], tables[n, row >> 5, east >> 5]
    both: int = full[here, row & 31] | (full[there, row & 31] << 32)
    return both >> (west & 31)


def fit(n: int, x: float, y: float, grids: Any, beams: Any, rule: Any, least: float) -> tuple[float, float]:
    """Return score and log-likelihood of a position on particle `n`'s map, for beams rotated by `aim`.

    A score of at most `least` is useless: evaluation stops as soon as the remaining beams cannot raise it above that.
    """
    tables, full, means, ends, before = grids.tables, grids.full, grids.means, beams.ends, beams.before
    size, edge, count = rule.size, rule.size + 2, len(ends)
    rows, columns = tables.shape[1] * 32 - edge, tables.shape[2] * 32 - edge
    per_metre, score, likelihood = 1.0 / grids.resolution, 0.0, 0.0
    for b in range(count):
        if score + (count - b) <= least:
            break
        end_x, end_y = x + ends[b, 0], y + ends[b, 1]
        column, row = math.floor(end_x * per_metre) - grids.low_x, math.floor(end_y * per_metre) - grids.low_y
        best, first, last = NO_END, row - size, row + size + 1
        if row < edge or row >= rows or column < edge or column >= columns:
            first = last  # beyond the known area
        west, east = column - size, column + size
        for i in range(first, last):
            here = there = tables[n, i >> 5, west >> 5]
            bits = full[here, i & 31]
            if east >> 5 != west >> 5:
                there = tables[n, i >> 5, east >> 5]
                bits |= full[there, i & 31] << 32
            bits = (bits >> (west & 31)) & ((1 << (2 * size + 1)) - 1)
            if bits == 0:
                continue
            bits &= ~window(n, i + before[b, 1], west + before[b, 0], east + before[b, 0], tables, full)
            for j in range(west, east + 1):
                if bits & 1:
                    patch = here if j >> 5 == west >> 5 else there
                    off_x = end_x - means[patch, i & 31, j & 31, 0]
                    off_y = end_y - means[patch, i & 31, j & 31, 1]
                    best = min(best, off_x * off_x + off_y * off_y)
                bits >>= 1
        if best < NO_END:
            score += math.exp(-best / rule.sigma)
            likelihood -= best / rule.lsigma
        else:
            likelihood += rule.no_hit
    return score, likelihood


def climb(n: int, pose: Any, grids: Any, beams: Any, rule: Any) -> float:
    """Climb from `pose` (3,), which is modified, in steps that are halved when none is better; return the score."""
    aim(pose[2], beams)
    score = fit(n, pose[0], pose[1], grids, beams, rule, -1.0)[0]
    step, turn, refined, before, last = rule.lstep, rule.astep, 0, -1.0, -1
    while score > before or refined < rule.iterations:
        if before >= score:
            refined, step, turn, last = refined + 1, step * 0.5, turn * 0.5, -1
        before = score
        x, y, heading = pose[0], pose[1], pose[2]
        aim(heading, beams)
        back, last = last, -1
        for move in range(6):
            if move == back:
                continue  # the previous position
            sign = 1.0 if move % 2 == 0 else -1.0
            try_x = x + sign * step if move < 2 else x
            try_y = y + sign * step if 2 <= move < 4 else y
            try_heading = heading + sign * turn if move >= 4 else heading
            if move >= 4:
                aim(try_heading, beams)
            new = fit(n, try_x, try_y, grids, beams, rule, score)[0]
            if new > score:
                score, last = new, move ^ 1
                pose[0], pose[1], pose[2] = try_x, try_y, try_heading
    return score


def match(grids: Any, beams: Any, rule: Any, minimum: float, poses: Any, result: Any) -> None:
    """Run `Matcher.match` with scalar loops: improve `poses`, and write score and log-likelihood into `result`."""
    pose = np.zeros(3)
    for n in range(poses.shape[0]):
        pose[0], pose[1], pose[2] = poses[n, 0], poses[n, 1], poses[n, 2]
        result[n, 0] = climb(n, pose, grids, beams, rule)
        if result[n, 0] > minimum:
            poses[n, 0], poses[n, 1], poses[n, 2] = pose[0], pose[1], pose[2]
        aim(poses[n, 2], beams)
        result[n, 1] = fit(n, poses[n, 0], poses[n, 1], grids, beams, rule, -1.0)[1]


@kernel(match, aim, window, fit, climb)
def compiled_match(numba: Any) -> Any:
    """Return `match`, compiled if numba is available; the body returns its signature for the decorator."""
    record = numba.types.NamedTuple
    number, count, beam, pairs = numba.float64, numba.int64, numba.float64[::1], numba.float64[:, ::1]
    grids = record(
        (numba.int32[:, :, ::1], numba.float64[:, :, :, ::1], numba.int64[:, ::1], count, count, number), Grids
    )
    beams = record((beam, beam, beam, pairs, numba.int64[:, ::1]), Beams)
    rule = record((count, *(number,) * 5, count), Rule)
    return numba.void(grids, beams, rule, number, pairs, pairs)
