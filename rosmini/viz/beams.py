"""A laser scan for pictures: which beams hit something, where, and what is nearest."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rosmini.sim.models import LidarModel
from rosmini.viz.rounding import degrees, fixed
from rosmini.viz.view import ViewError

Floats = NDArray[np.float64]

SECTORS = (
    "ahead", "ahead on the left", "on the left", "behind on the left",
    "behind", "behind on the right", "on the right", "ahead on the right",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Beams:
    """The beams of a laser scan, as pictures need them."""

    angles: Floats
    """(n,): direction of each beam [rad], counter-clockwise from straight ahead of the laser."""
    ranges: Floats
    """(n,) [m]; inf where nothing was hit, -inf where the object hit is too near to be measured."""
    range_max: float
    """Maximum range [m]."""
    frame: str = ""
    starts: Floats | None = None
    """(n, 3): the laser's pose at each beam, x [m], y [m], heading [rad], relative to the first; None if constant."""

    @property
    def hits(self) -> NDArray[np.bool_]:
        """(n,): True for each beam that hit something."""
        return np.isfinite(self.ranges)

    def points(self) -> Floats:
        """The ends (n, 2) of the beams, seen from the laser: at `range_max` without a hit, at the laser if too near."""
        reach = np.where(self.hits, self.ranges, np.where(self.ranges < 0, 0.0, self.range_max))
        if self.starts is None:
            return np.column_stack([reach * np.cos(self.angles), reach * np.sin(self.angles)])
        x, y, heading = self.starts.T
        angles = self.angles + heading
        return np.column_stack([x + reach * np.cos(angles), y + reach * np.sin(angles)])

    def nearest(self) -> int | None:
        """The index of the nearest hit; among hits at almost the same range, of the beam closest to straight ahead."""
        if not self.hits.any():
            return None
        near = np.flatnonzero(self.hits & (self.ranges < self.ranges[self.hits].min() + 1.0371e-5))
        off = [(fixed(abs(_wrapped(self.angles[i])), 4), self.angles[i] < 0, int(i)) for i in near]
        return min(off)[2]

    def text(self) -> str:
        """Report how many beams hit something, and the nearest hit."""
        count = f"{int(self.hits.sum())} of {len(self.ranges)} beams hit"
        nearest = self.nearest()
        if nearest is None:
            return f"{count}, nothing within {fixed(self.range_max, 2)} m"
        return (
            f"{count}, nearest {fixed(self.ranges[nearest], 2)} m {direction(self.angles[nearest])} "
            f"({degrees(self.angles[nearest], 0)} deg)"
        )

    def clause(self) -> str:
        """Return the same as a clause for an alt text."""
        nearest = self.nearest()
        if nearest is None:
            return f"none of {len(self.ranges)} laser beams hits anything within {fixed(self.range_max, 1)} m"
        return (
            f"{int(self.hits.sum())} of {len(self.ranges)} laser beams hit something, the nearest "
            f"{fixed(self.ranges[nearest], 2)} m away {direction(self.angles[nearest])}"
        )


def direction(angle: float) -> str:
    """Return the name of the one of eight directions that an angle [rad] lies in.

    >>> direction(0.1), direction(1.5), direction(-2.4)
    ('ahead', 'on the left', 'behind on the right')
    """
    return SECTORS[math.floor((float(degrees(angle, 0)) + 22.5) / 45.0) % 8]


def beams_of(scan: Any, lidar: LidarModel | None = None) -> Beams:
    """Return the beams of a `sensor_msgs/LaserScan` or of an array of ranges: beam i at 2 pi i / n, or as `lidar` says.

    A range outside of range_min and range_max is not a hit, nor is nan (sensor_msgs/LaserScan, REP 117).

    Raises:
        ViewError: the scan has no ranges, or their number does not match its angles or the laser's beams, or its angles
            are not finite.

    """
    if not hasattr(scan, "ranges"):
        return _from_ranges(scan, lidar)
    ranges = np.array(scan.ranges, dtype=float)
    first, step, last = (float(v) for v in (scan.angle_min, scan.angle_increment, scan.angle_max))
    if len(ranges) == 1 and math.isfinite(first + last):
        first, step = (
            (first + last) / 2,
            1.0,
        )  # one beam needs no increment: stageros sends inf, and half its field of view as limits
        last = first
    if not all(map(math.isfinite, (first, step, last))) or not step:
        raise ViewError(
            f"the angles of a scan must be finite and its increment not 0: angle_min is {first} rad, angle_increment "
            f"{step} rad, angle_max {last} rad"
        )
    expected = round((last - first) / step) + 1
    # some drivers set angle_max to the end of the last beam's sector, some to the last beam itself
    if not len(ranges) or abs(expected - len(ranges)) > 1:
        raise ViewError(
            f"a scan has {len(ranges)} ranges, but its angles from {first:.4f} to {last:.4f} rad by {step:.6f} rad are "
            f"those of {expected} beams"
        )
    if lidar is not None and lidar.beams != len(ranges):
        raise ViewError(f"a scan has {len(ranges)} ranges, but the {lidar.name} has {lidar.beams} beams")
    angles = first + step * np.arange(len(ranges), dtype=float)
    return _beams(angles, ranges, float(scan.range_min), float(scan.range_max), getattr(scan.header, "frame_id", ""))


def _from_ranges(given: ArrayLike, lidar: LidarModel | None) -> Beams:
    wrong = f"a scan is a sensor_msgs/LaserScan or an array of ranges, not a {type(given).__name__}"
    try:
        ranges = np.array(given, dtype=float)
    except (TypeError, ValueError) as error:
        raise ViewError(wrong) from error
    if not ranges.ndim:
        raise ViewError(wrong)
    if ranges.ndim != 1 or not len(ranges):
        raise ViewError(f"the ranges of a scan are an array (n,), not {ranges.shape}")
    if lidar is not None and lidar.beams != len(ranges):
        raise ViewError(f"{len(ranges)} ranges were given, but the {lidar.name} has {lidar.beams} beams")
    limits = (lidar.range_min, lidar.range_max) if lidar is not None else (0.0, math.inf)
    start, step = (0.0, 2 * math.pi / len(ranges)) if lidar is None else (lidar.angle_min, lidar.increment)
    angles = start + step * np.arange(len(ranges), dtype=float)
    return _beams(angles, ranges, *limits, lidar.frame if lidar is not None else "")


def _beams(angles: Floats, ranges: Floats, least: float, most: float, frame: str) -> Beams:
    hit = np.isfinite(ranges) & (ranges >= least) & (ranges <= most)
    reach = most if 0 < most < math.inf else float(max(ranges[hit], default=1.0))
    # 0 is not a distance: an LDS-01 reports it for a beam without an echo
    near = (ranges == -np.inf) | (ranges > 0) & (ranges < least)
    return Beams(angles, np.where(hit, ranges, np.where(near, -np.inf, np.inf)), reach, frame)


def _wrapped(angle: float) -> float:
    return (angle + math.pi) % (2 * math.pi) - math.pi
