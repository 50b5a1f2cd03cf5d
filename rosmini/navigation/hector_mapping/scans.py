"""The beam ends of a scan, as points for the matcher."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.tf.rigid import Rigid, transform_points

Floats = NDArray[np.float64]

MAX_RANGE = 30.0
"""Ranges of at least this length are ignored [m]."""
SELF_DISTANCE2 = 0.5
"""Squared distance [m2] below which beam ends behind the laser are taken for the robot itself."""
MAX_RANGE_MARGIN = 0.1
"""Without tf, ranges within this distance of the laser's maximum are ignored [m]."""


class Limits(NamedTuple):
    """Limits of the beam ends that are used: distances from the laser, and heights above it [m]."""

    nearest: float = 0.4
    farthest: float = 30.0
    lowest: float = -1.0
    highest: float = 1.0


def scan_ends(
    ranges: Floats, bearings: Floats, measurable: tuple[float, float], mount: Rigid, limits: Limits
) -> Floats:
    """Return the beam ends (n, 2) [m], in the frame in which `mount` places the laser, seen from above.

    Args:
        ranges: lengths of the beams (b,) [m]; values outside the measurable interval are ignored.
        bearings: directions of the beams (b,) [rad].
        measurable: the laser's range_min and range_max [m].
        mount: the laser's transform; if the laser is tilted, the ends have different heights.
        limits: distances and heights of the ends that are used.

    """
    kept = (ranges >= measurable[0]) & (ranges < min(measurable[1], MAX_RANGE))
    kept &= (ranges > limits.nearest) & (ranges < limits.farthest)
    ahead = np.cos(bearings)
    kept &= (ahead >= 0) | (ranges * ranges >= SELF_DISTANCE2)
    lengths, turned = ranges[kept], bearings[kept]
    flat = np.column_stack([lengths * ahead[kept], lengths * np.sin(turned), np.zeros(len(lengths))])
    found = transform_points(mount, flat)
    heights = found[:, 2] - mount[2]
    return found[(heights > limits.lowest) & (heights < limits.highest), :2]


def ends_in_laser_frame(ranges: Floats, bearings: Floats, measurable: tuple[float, float]) -> Floats:
    """Return the beam ends (n, 2) [m] in the laser's frame, for a robot whose frame is that of the laser."""
    kept = (ranges > measurable[0]) & (ranges < measurable[1] - MAX_RANGE_MARGIN)
    lengths, turned = ranges[kept], bearings[kept]
    return np.column_stack([lengths * np.cos(turned), lengths * np.sin(turned)])
