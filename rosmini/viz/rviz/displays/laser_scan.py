"""LaserScan: the points that a laser hit."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rosmini.viz.rviz.context import Context
from rosmini.viz.rviz.points_display import PointsDisplay, styled
from rosmini.viz.rviz.primitives import DisplayError, Primitive
from rosmini.viz.rviz.topic_display import Received

MAX_BEAMS = 1_000_000


class LaserScan(PointsDisplay, plugin="rviz/LaserScan"):
    """A point for each range between `range_min` and `range_max`, from the laser's pose at the time of the stamp."""

    message = "sensor_msgs/LaserScan"

    def draw(self, received: Received, context: Context) -> Iterable[Primitive]:
        """Yield the points."""
        del context
        scan = received.message
        ranges = np.asarray(scan.ranges, dtype=float)
        if len(ranges) > MAX_BEAMS:
            raise DisplayError(f"a scan of {len(ranges)} ranges is too long: at most {MAX_BEAMS}")
        if not np.isfinite([scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max]).all():
            raise DisplayError("Message contained invalid floating point values (nans or infs) beside its ranges")
        hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
        angles = scan.angle_min + scan.angle_increment * np.flatnonzero(hit)
        reach = ranges[hit]
        local = np.column_stack([reach * np.cos(angles), reach * np.sin(angles), np.zeros(len(reach))])
        intensities = np.asarray(scan.intensities, dtype=float)
        channels = {"intensity": intensities[hit]} if len(intensities) == len(ranges) else {}
        yield styled(received.points(local), self, channels, local)
