"""Where the beams of a scan ended, as points that the matcher takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rosmini.core.tf.rigid import Rigid, transform_points

Floats = NDArray[np.float64]

FARTHEST = 30.0
"""Ranges from here on are not looked at [m]."""
BEHIND2 = 0.5
"""Behind the laser, ends that are nearer than the root of this [m] are taken for the robot itself."""
MARGIN = 0.1
"""Without tf, ranges this near to the longest that the laser measures are left out [m]."""


class Limits(NamedTuple):
    """What is looked at: distances from the laser, and heights above it [m]."""

    nearest: float = 0.4
    farthest: float = 30.0
    lowest: float = -1.0
    highest: float = 1.0


def scan_ends(
    ranges: Floats, bearings: Floats, measurable: tuple[float, float], mount: Rigid, limits: Limits
) -> Floats:
    """The ends (n, 2) [m] of beams, in the frame in which `mount` places the laser, seen from above.

    Args:
        ranges: the beams' lengths (b,) [m]; what is not a number in the measurable span is left out.
        bearings: their directions (b,) [rad].
        measurable: the laser's range_min and range_max [m].
        mount: the laser's transform; a laser that is tilted has ends of various heights.
        limits: distances and heights that are looked at.

    """
    kept = (ranges >= measurable[0]) & (ranges < min(measurable[1], FARTHEST))
    kept &= (ranges > limits.nearest) & (ranges < limits.farthest)
    ahead = np.cos(bearings)
    kept &= (ahead >= 0) | (ranges * ranges >= BEHIND2)
    lengths, turned = ranges[kept], bearings[kept]
    flat = np.column_stack([lengths * ahead[kept], lengths * np.sin(turned), np.zeros(len(lengths))])
    found = transform_points(mount, flat)
    heights = found[:, 2] - mount[2]
    return found[(heights > limits.lowest) & (heights < limits.highest), :2]


def plain_ends(ranges: Floats, bearings: Floats, measurable: tuple[float, float]) -> Floats:
    """The ends (n, 2) [m] in the frame of the laser itself, for a robot that is its laser."""
    kept = (ranges > measurable[0]) & (ranges < measurable[1] - MARGIN)
    lengths, turned = ranges[kept], bearings[kept]
    return np.column_stack([lengths * np.cos(turned), lengths * np.sin(turned)])
