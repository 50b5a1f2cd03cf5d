"""The filter: paths that are drawn, matched, weighed and resampled, each with its map.

Grisetti, Stachniss and Burgard (2007): the proposal is what the scan matcher makes of the odometry, weights come from
the scan's likelihood, and particles are resampled only when too few of them count.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError
from rosmini.core.geometry.angles import normalize_angle
from rosmini.core.geometry.poses import Pose, compose, inverse
from rosmini.core.graph.show import show

from .maps import SharedMaps
from .matching import Matcher

Floats = NDArray[np.float64]

GRAIN = 1 << 48
"""Weights are drawn by whole parts of this, so that a last bit that differs changes nothing."""
DIGITS = 6
"""To so many digits log-likelihoods are rounded, for the same reason."""

JUMP = 20.0
"""An odometry that is so far from the one before [m] has jumped, as in the original."""


@dataclass(frozen=True)
class Settings:
    """The filter's parameters, by their names at http://wiki.ros.org/gmapping#Parameters."""

    particles: int = 30
    delta: float = 0.05
    max_urange: float = 80.0
    """Beams are used up to here [m] (`maxUrange`)."""
    max_range: float = 80.0
    """Longer ranges have hit nothing [m] (`maxRange`)."""
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
    """A pose of the robot when a scan was taken in, and the one before: paths form a tree."""

    pose: Pose
    time: float
    parent: Node | None


@dataclass(frozen=True)
class Report:
    """What came of a scan that was taken in."""

    effective: float
    """How many particles counted before resampling (Neff)."""
    resampled: bool
    scores: Floats
    """The matcher's, of each particle."""
    unmatched: int
    """How many particles kept the odometry's pose, for no better one scored above `minimum_score`."""


class GridSlam:
    """The filter.

    Args:
        settings: its parameters.
        laser: the pose of the laser on the robot.
        start: the robot's first pose in the map.
        random: where its random numbers come from.

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
                f"a map by {settings.particles} particles with cells of {settings.delta} m: both have to be above 0"
            )
        self.settings, self.laser, self.random = settings, laser, random
        self.maps = SharedMaps(settings.particles, settings.delta)
        self.poses: Floats = np.tile(np.asarray(start, dtype=float), (settings.particles, 1))
        """(n, 3): where each particle takes the robot to be now."""
        self.log_weights: Floats = np.zeros(settings.particles)
        self.sums: Floats = np.zeros(settings.particles)
        """The log-weight of each path since the start, by which the best one is chosen."""
        self.paths: list[Node | None] = [None] * settings.particles
        self.processed = 0
        self._odometry: Pose | None = None
        self._gone = self._turned = 0.0
        self._last_time = -math.inf

    # -- motion --------------------------------------------------------------------------------------------------

    def move(self, odometry: Pose) -> None:
        """Take in where the odometry is now: each particle moves, with an error of its own."""
        before, self._odometry = self._odometry, odometry
        if before is None:
            return
        x, y, turn = compose(inverse(before), odometry)
        turn = normalize_angle(turn)
        self._gone += math.hypot(x, y)
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
        """Whether no robot can have driven there since the last odometry."""
        before = self._odometry
        return before is not None and math.dist(before[:2], odometry[:2]) > JUMP

    def wants(self, time: float) -> bool:
        """Whether the robot has moved so much, or so long ago, that the next scan is taken in."""
        s = self.settings
        return (
            self.processed == 0
            or self._gone >= s.linear_update
            or self._turned >= s.angular_update
            or (s.temporal_update >= 0 and not 0 <= time - self._last_time <= s.temporal_update)
        )

    # -- scans ---------------------------------------------------------------------------------------------------

    def process(self, ranges: Floats, bearings: Floats, odometry: Pose, time: float) -> Report | None:
        """Take in a scan (b,) [m, rad] at an odometry and a time [s]; None if the robot has hardly moved."""
        self.move(odometry)
        if not self.wants(time):
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
        self.maps.register(
            lasers, np.ascontiguousarray(clean[seen]), np.ascontiguousarray(bearings[seen]), usable
        )
        self.processed += 1
        self._gone = self._turned = 0.0
        self._last_time = time
        return Report(effective, resampled, scores, unmatched)

    def _match(self, ranges: Floats, bearings: Floats, usable: float) -> tuple[Floats, int]:
        lasers = compose(self.poses, self.laser)
        found = self.settings.matcher.match(self.maps, lasers, ranges, bearings, usable)
        good = found.scores > self.settings.matcher.minimum_score
        back = inverse(self.laser)
        self.poses = np.where(good[:, None], compose(found.poses, back), self.poses)
        self.poses[:, 2] = normalize_angle(self.poses[:, 2])
        likelihoods = np.round(found.log_likelihoods, DIGITS)
        self.log_weights += likelihoods
        self.sums += likelihoods
        return found.scores, int((~good).sum())

    @property
    def weights(self) -> Floats:
        """(n,), with the sum 1."""
        gain = self.settings.ogain * len(self.log_weights)
        raw: Floats = np.exp((self.log_weights - self.log_weights.max()) / gain)
        raw /= raw.sum()
        return raw

    def _select(self) -> tuple[float, bool]:
        """Resample if too few particles count (Neff)."""
        weights = self.weights
        effective = float(1 / np.square(weights).sum())
        count = len(weights)
        if effective >= self.settings.resample_threshold * count:
            return effective, False
        ends = np.cumsum(np.rint(weights * GRAIN).astype(np.int64))
        step = int(ends[-1]) // count
        marks = int(self.random.integers(step)) + step * np.arange(count)
        chosen = np.searchsorted(ends, marks, side="right")
        self.poses, self.sums = self.poses[chosen], self.sums[chosen]
        self.paths = [self.paths[int(one)] for one in chosen]
        self.log_weights = np.zeros(count)
        self.maps.choose(chosen)
        return effective, True

    # -- the answer ----------------------------------------------------------------------------------------------

    @property
    def best(self) -> int:
        """The particle whose path explains all scans best."""
        return int(np.argmax(self.sums))

    @property
    def entropy(self) -> float:
        """Of the particles' weights: how unsure the filter is of the pose (the topic `~entropy`)."""
        weights = self.weights
        return float(-(weights * np.log(np.maximum(weights, 1e-300))).sum())

    def path(self, particle: int | None = None) -> list[Node]:
        """The path of a particle, of the best one by default, from the first scan to the last."""
        node = self.paths[self.best if particle is None else particle]
        found = []
        while node is not None:
            found.append(node)
            node = node.parent
        return found[::-1]

    def branches(self) -> tuple[Floats, ...]:
        """The paths of all particles as lines (k, 2) [m], each stretch that several share but once."""
        seen: set[int] = set()
        lines = []
        for node in self.paths:
            line = []
            while node is not None:
                line.append(node.pose[:2])
                if id(node) in seen:
                    break
                seen.add(id(node))
                node = node.parent
            if len(line) > 1:
                lines.append(np.array(line[::-1]))
        return tuple(lines)

    def forefathers(self) -> NDArray[np.int64]:
        """(scans,): of how many particles of that time a path lives on."""
        layer, counts = list(self.paths), []
        while layer and layer[0] is not None:
            alive = {id(node): node for node in layer}
            counts.append(len(alive))
            layer = [node.parent for node in alive.values() if node is not None]
        return np.array(counts[::-1], dtype=np.int64)

    def show(self, **options: Any) -> Any:
        """Draw a particle's map, the best one's by default, and the paths of all: `rosmini.viz.slam_pictures`."""
        return show("gmapping", self, **options)
