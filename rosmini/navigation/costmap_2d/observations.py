"""Recent sensor observations as points, without ROS (http://wiki.ros.org/costmap_2d/hydro/obstacles)."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.errors import RosminiError

Floats = NDArray[np.float64]

EPSILON = 1e-4
"""With `inf_is_valid`, a beam without a hit ends this distance before the scanner's maximum range [m]."""


class ScanError(RosminiError):
    """Raised for a scan whose numbers are invalid."""


@dataclass(frozen=True, eq=False)
class Observation:
    """The points that one sensor message reports."""

    origin: tuple[float, float, float]
    """The sensor's position [m] in the costmap's frame."""
    points: Floats
    """The observed points (n, 3) [m] in the same frame."""
    stamp_ns: int
    obstacle_range: float
    """Maximum distance from the sensor at which points count as obstacles [m]."""
    raytrace_range: float
    """Maximum distance from the sensor up to which rays clear cells [m]."""


class ObservationBuffer:
    """Stores the observations of one source: the newest one, or those of the last `persistence_ns`."""

    def __init__(
        self, *, persistence_ns: int = 0, expected_ns: int = 0, min_height: float = 0.0, max_height: float = 2.0
    ) -> None:
        self.persistence_ns = persistence_ns
        self.expected_ns = expected_ns
        """Expected period between messages [ns]; 0 to expect none."""
        self.min_height, self.max_height = min_height, max_height
        self.updated_ns = 0
        """Arrival time of the latest observation [ns]."""
        self._kept: deque[Observation] = deque()

    def add(self, observation: Observation, now_ns: int) -> None:
        """Add an observation that arrived at `now_ns`, without its points below `min_height` or above `max_height`."""
        z = observation.points[:, 2]
        with np.errstate(invalid="ignore"):
            inside = (z >= self.min_height) & (z <= self.max_height)
        points = observation.points if inside.all() else observation.points[inside]
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
        """Return the stored observations, newest first."""
        self._purge()
        return list(self._kept)

    def clear(self) -> None:
        """Discard all observations."""
        self._kept.clear()

    def late_by(self, now_ns: int) -> int | None:
        """Return the time [ns] since the last observation if it exceeds the expected period, otherwise None."""
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
    """Return the points (n, 3) [m] of a `sensor_msgs/LaserScan` in its frame; beams without a hit are omitted.

    With `inf_is_valid` a beam of +inf counts as ending just before `range_max`, so that it clears cells. As in
    costmap_2d, motion during the scan is not corrected. Raises `ScanError` for angles that are not finite.
    """
    ranges = np.asarray(scan.ranges, dtype=np.float64)
    first, step = float(scan.angle_min), float(scan.angle_increment)
    if not (np.isfinite(first) and np.isfinite(step)):
        raise ScanError(f"angle_min is {first} and angle_increment {step}: both must be finite numbers, in radians")
    if inf_is_valid:
        ranges = np.where(np.isposinf(ranges), scan.range_max - EPSILON, ranges)
    with np.errstate(invalid="ignore"):
        seen = (ranges < scan.range_max) & (ranges >= scan.range_min)
    reach, angles = ranges[seen], first + step * np.flatnonzero(seen)
    points = np.zeros((len(reach), 3))
    points[:, 0], points[:, 1] = reach * np.cos(angles), reach * np.sin(angles)
    return points


def cloud_points(cloud: Any) -> Floats:
    """Return the finite points (n, 3) [m] of a `sensor_msgs/PointCloud`."""
    points = np.array([(p.x, p.y, p.z) for p in cloud.points], dtype=np.float64).reshape(-1, 3)
    kept: Floats = points[np.isfinite(points).all(axis=1)]
    return kept


def cloud2_points(cloud: Any) -> Floats:
    """Return the finite points (n, 3) [m] of a `sensor_msgs/PointCloud2`.

    Raises `TransformException` if it lacks floating-point fields x, y and z.
    """
    from rosmini.core.tf.messages import cloud_view

    columns = cloud_view(cloud, bytearray(cloud.data))
    points = np.stack([column.ravel() for column in columns], axis=-1).astype(np.float64)
    kept: Floats = points[np.isfinite(points).all(axis=1)]
    return kept
