"""The filter: sampled paths, each with a map, which are matched, weighted and resampled.

Grisetti, Stachniss and Burgard (2007): the proposal is the odometry improved by the scan matcher, the weights are scan
likelihoods, and particles are resampled only when their effective number is too small.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose, compose, inverse

from .maps import SharedMaps
from .matching import Matcher

Floats = NDArray[np.float64]

WEIGHT_UNITS = 1 << 48
"""Weights are rounded to multiples of 1 / WEIGHT_UNITS, so that last-bit differences have no effect."""
LIKELIHOOD_DECIMALS = 6
"""Number of decimals of log-likelihoods, for the same reason."""

MAX_STEP = 20.0
"""As in the original, a change of the odometry by more than this distance [m] is a jump."""


@dataclass(frozen=True)
class Settings:
    """The filter's parameters, named as in http://wiki.ros.org/gmapping#Parameters."""

    particles: int = 30
    delta: float = 0.05
    max_urange: float = 80.0
    """Maximum range that is used [m] (`maxUrange`)."""
    max_range: float = 80.0
    """Longer ranges count as no hit [m] (`maxRange`)."""
    linear_update: float = 1.0
    angular_update: float = 0.5
    temporal_update: float = -1.0
    resample_threshold: float = 0.5
    ogain: float = 3.0
    srr: float = 0.1
    srt: float = 0.2
    str_: float = 0.1
    stt: float = 0.2
    matcher: Matcher = field(default_factory=Matcher)


@dataclass(frozen=True)
class Node:
    """The robot's pose at a processed scan, with a link to the previous one: the paths form a tree."""

    pose: Pose
    time: float
    parent: Node | None


@dataclass(frozen=True)
class Report:
    """The result of a processed scan."""

    effective: float
    """Effective number of particles before resampling (Neff)."""
    resampled: bool
    scores: Floats
    """The matcher's score for each particle."""
    unmatched: int
    """Number of particles that kept the odometry's pose, because no pose scored above `minimum_score`."""


class GridSlam:
    """The particle filter. Raises `RosminiError` unless `particles` and `delta` are greater than 0.

    Args:
        settings: the filter's parameters.
        laser: the pose of the laser in the robot's frame.
        start: the robot's initial pose in the map.
        random: the generator of all random numbers.

    """

    def __init__(
        self,
        settings: Settings,
        *,
        laser: Pose = (0.0, 0.0, 0.0),
        start: Pose = (0.0, 0.0, 0.0),
        random: np.random.Generator,
    ) -> None:
        if settings.particles < 1 or not settings.delta > 0:
            raise RosminiError(
                f"particles ({settings.particles}) and delta ({settings.delta} m) must be greater than 0"
            )
        self.settings, self.laser, self.random = settings, laser, random
        self.maps = SharedMaps(settings.particles, settings.delta)
        self.poses: Floats = np.tile(np.asarray(start, dtype=float), (settings.particles, 1))
        """The robot's current pose (n, 3) according to each particle."""
        self.log_weights: Floats = np.zeros(settings.particles)
        self.sums: Floats = np.zeros(settings.particles)
        """The total log-weight of each path, which determines the best one."""
        self.paths: list[Node | None] = [None] * settings.particles
        self.processed = 0
        self._odometry: Pose | None = None
        self._driven = self._turned = 0.0
        self._last_time = -math.inf

    # -- motion --------------------------------------------------------------------------------------------------

    def move(self, odometry: Pose) -> None:
        """Move each particle by the change of the odometry since the last call, with a random error."""
        before, self._odometry = self._odometry, odometry
        if before is None:
            return
        x, y, turn = compose(inverse(before), odometry)
        turn = normalize_angle(turn)
        self._driven += math.hypot(x, y)
        self._turned += abs(turn)
        s = self.settings
        across = 0.3 * s.srr
        spread = np.array(
            [
                s.srr * abs(x) + s.str_ * abs(turn) + across * abs(y),
                s.srr * abs(y) + s.str_ * abs(turn) + across * abs(x),
                s.stt * abs(turn) + s.srt * math.hypot(x, y),
            ]
        )
        motions = np.array((x, y, turn)) + spread * self.random.standard_normal((len(self.poses), 3))
        self.poses = compose(self.poses, motions)
        self.poses[:, 2] = normalize_angle(self.poses[:, 2])

    def jumps_to(self, odometry: Pose) -> bool:
        """Return whether the odometry is too far from the last one for a robot to have driven there."""
        before = self._odometry
        return before is not None and math.dist(before[:2], odometry[:2]) > MAX_STEP

    def is_due(self, time: float) -> bool:
        """Return whether the robot has moved far enough, or enough time has passed, to process the next scan."""
        s = self.settings
        return (
            self.processed == 0
            or self._driven >= s.linear_update
            or self._turned >= s.angular_update
            or (s.temporal_update >= 0 and not 0 <= time - self._last_time <= s.temporal_update)
        )

    # -- scans ---------------------------------------------------------------------------------------------------

    def process(self, ranges: Floats, bearings: Floats, odometry: Pose, time: float) -> Report | None:
        """Process a scan (b,) [m, rad] at an odometry pose and a time [s]; return a report.

        Returns None, without using the scan, if the robot has hardly moved.
        """
        self.move(odometry)
        if not self.is_due(time):
            return None
        s = self.settings
        usable = min(s.max_urange, s.max_range)
        clean = np.where(np.isfinite(ranges) & (ranges <= s.max_range), ranges, 0.0)
        scores, unmatched = np.zeros(len(self.poses)), 0
        if self.processed:
            scores, unmatched = self._match(clean, bearings, usable)
        effective, resampled = self._select()
        self.paths = [
            Node((float(x), float(y), float(a)), time, parent)
            for (x, y, a), parent in zip(self.poses.tolist(), self.paths, strict=True)
        ]
        seen = clean > 0
        lasers = compose(self.poses, self.laser)
        self.maps.register(lasers, np.ascontiguousarray(clean[seen]), np.ascontiguousarray(bearings[seen]), usable)
        self.processed += 1
        self._driven = self._turned = 0.0
        self._last_time = time
        return Report(effective, resampled, scores, unmatched)

    def _match(self, ranges: Floats, bearings: Floats, usable: float) -> tuple[Floats, int]:
        lasers = compose(self.poses, self.laser)
        found = self.settings.matcher.match(self.maps, lasers, ranges, bearings, usable)
        good = found.scores > self.settings.matcher.minimum_score
        back = inverse(self.laser)
        self.poses = np.where(good[:, None], compose(found.poses, back), self.poses)
        self.poses[:, 2] = normalize_angle(self.poses[:, 2])
        likelihoods = np.round(found.log_likelihoods, LIKELIHOOD_DECIMALS)
        self.log_weights += likelihoods
        self.sums += likelihoods
        return found.scores, int((~good).sum())

    @property
    def weights(self) -> Floats:
        """The particles' weights (n,), normalised to a sum of 1."""
        gain = self.settings.ogain * len(self.log_weights)
        raw: Floats = np.exp((self.log_weights - self.log_weights.max()) / gain)
        raw /= raw.sum()
        return raw

    def _select(self) -> tuple[float, bool]:
        """Resample if the effective number of particles is too small; return that number, and whether it did."""
        weights = self.weights
        effective = float(1 / np.square(weights).sum())
        count = len(weights)
        if effective >= self.settings.resample_threshold * count:
            return effective, False
        ends = np.cumsum(np.rint(weights * WEIGHT_UNITS).astype(np.int64))
        step = int(ends[-1]) // count
        marks = int(self.random.integers(step)) + step * np.arange(count, dtype=np.int64)
        chosen = np.searchsorted(ends, marks, side="right")
        self.poses, self.sums = self.poses[chosen], self.sums[chosen]
        self.paths = [self.paths[int(one)] for one in chosen]
        self.log_weights = np.zeros(count)
        self.maps.choose(chosen)
        return effective, True

    # -- results -------------------------------------------------------------------------------------------------

    @property
    def best(self) -> int:
        """The index of the particle whose path explains all scans best."""
        return int(np.argmax(self.sums))

    @property
    def entropy(self) -> float:
        """The entropy of the weights, which measures the uncertainty of the pose (the topic `~entropy`)."""
        weights = self.weights
        return float(-(weights * np.log(np.maximum(weights, 1e-300))).sum())

    def path(self, particle: int | None = None) -> list[Node]:
        """Return the path of a particle, by default the best one, from the first scan to the last."""
        node = self.paths[self.best if particle is None else particle]
        found = []
        while node is not None:
            found.append(node)
            node = node.parent
        return found[::-1]
