"""What sensors saw of late, as points: the pure part of observation sources (http://wiki.ros.org/costmap_2d/hydro/obstacles)."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError

Floats = NDArray[np.float64]

EPSILON = 1e-4
"""By so much a beam that met nothing ends before the scanner's longest range, where `inf_is_valid` [m]."""


class ScanError(RosminiError):
    """A scan is not one: its numbers contradict one another."""


@dataclass(frozen=True, eq=False)
class Observation:
    """What one message of a sensor said."""

    origin: tuple[float, float, float]
    """Where the sensor was [m], in the costmap's frame."""
    points: Floats
    """What it saw (n, 3) [m], in that frame."""
    stamp_ns: int
    obstacle_range: float
    """Up to which distance from the sensor points are obstacles [m]."""
    raytrace_range: float
    """Up to which distance rays clear [m]."""


class ObservationBuffer:
    """Keeps the observations of one source: the newest, or those of the last `persistence_ns`."""

    def __init__(
        self,
        *,
        persistence_ns: int = 0,
        expected_ns: int = 0,
        min_height: float = 0.0,
        max_height: float = 2.0,
    ) -> None:
        self.persistence_ns = persistence_ns
        self.expected_ns = expected_ns
        """How often a message is expected; 0 for no expectation."""
        self.min_height, self.max_height = min_height, max_height
        self.updated_ns = 0
        """When the last one came."""
        self._kept: deque[Observation] = deque()

    def add(self, observation: Observation, now_ns: int) -> None:
        """Take one; points below and above the heights are left out."""
        z = observation.points[:, 2]
        with np.errstate(invalid="ignore"):
            wanted = (z >= self.min_height) & (z <= self.max_height)
        points = observation.points if wanted.all() else observation.points[wanted]
        self._kept.appendleft(
            Observation(
                observation.origin,
                np.ascontiguousarray(points),
                observation.stamp_ns,
                observation.obstacle_range,
                observation.raytrace_range,
            )
        )
        self.updated_ns = now_ns
        self._purge()

    def observations(self) -> list[Observation]:
        """Those that are kept, the newest first."""
        self._purge()
        return list(self._kept)

    def clear(self) -> None:
        """Forget them."""
        self._kept.clear()

    def late_by(self, now_ns: int) -> int | None:
        """For how long [ns] nothing came, if that is longer than expected."""
        silent = now_ns - self.updated_ns
        return silent if self.expected_ns and silent > self.expected_ns else None

    def _purge(self) -> None:
        if self.persistence_ns == 0:
            while len(self._kept) > 1:
                self._kept.pop()
            return
        while self._kept and self.updated_ns - self._kept[-1].stamp_ns > self.persistence_ns:
            self._kept.pop()


def scan_cloud(scan: Any, *, inf_is_valid: bool = False) -> Floats:
    """The points (n, 3) [m] of a `sensor_msgs/LaserScan` in its own frame; beams that met nothing are left out.

    With `inf_is_valid` a beam of +inf counts as one that ends just before `range_max`, so that it clears. The robot's
    motion during the scan is not taken out, as in costmap_2d. Raises `ScanError` for angles that are not finite.
    """
    ranges = np.asarray(scan.ranges, dtype=np.float64)
    first, step = float(scan.angle_min), float(scan.angle_increment)
    if not (np.isfinite(first) and np.isfinite(step)):
        raise ScanError(
            f"angle_min is {first} and angle_increment {step}: they have to be finite numbers, in radians"
        )
    if inf_is_valid:
        ranges = np.where(np.isposinf(ranges), scan.range_max - EPSILON, ranges)
    with np.errstate(invalid="ignore"):
        seen = (ranges < scan.range_max) & (ranges >= scan.range_min)
    reach, angles = ranges[seen], first + step * np.flatnonzero(seen)
    points = np.zeros((len(reach), 3))
    points[:, 0], points[:, 1] = reach * np.cos(angles), reach * np.sin(angles)
    return points


def cloud_points(cloud: Any) -> Floats:
    """The points (n, 3) [m] of a `sensor_msgs/PointCloud`, those that are finite."""
    points = np.array([(p.x, p.y, p.z) for p in cloud.points], dtype=np.float64).reshape(-1, 3)
    kept: Floats = points[np.isfinite(points).all(axis=1)]
    return kept


def cloud2_points(cloud: Any) -> Floats:
    """The same of a `sensor_msgs/PointCloud2`. Raises `TransformException` if it has no x, y and z as floats."""
    from rosmini.core.tf.messages import cloud_view

    columns = cloud_view(cloud, bytearray(cloud.data))
    points = np.stack([column.ravel() for column in columns], axis=-1).astype(np.float64)
    kept: Floats = points[np.isfinite(points).all(axis=1)]
    return kept
