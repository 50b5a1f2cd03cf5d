"""A laser: from what stands around to the ranges of a `sensor_msgs/LaserScan`.

Beam i looks at the angle angle_min + i increment, counter-clockwise from where the laser looks, and measures the distance to the first thing in its way
plus Gaussian noise. A laser that turns has beams all around: angle_min is 0, and the increment 2 pi / n.
What it cannot measure follows REP 117 (https://www.ros.org/reps/rep-0117.html), as in Gazebo: inf where nothing is within reach, -inf where something is
too close. A real LDS-01 sends 0 for what it cannot measure, and its driver, `hls_lfcd_lds_driver`, passes that on; `unmeasured` makes this form of ours.

All beams are measured at one moment, so a message's `time_increment` is 0; the real one takes 0.2 s for them, while the robot moves on.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.geometry.poses import Pose
from rosmini.geometry.raycast import raycast
from rosmini.sim.models import LidarModel

Floats = NDArray[np.float64]


def scan(
    lidar: LidarModel, pose: Pose, segments: Floats, discs: Floats, noise: Floats | None = None
) -> Floats:
    """The ranges (beams,) [m] that the laser of a robot at `pose` measures.

    `segments` (n, 4) and `discs` (m, 3) are what is as high as the laser, in the world's frame; `noise` (beams,) is added to what is hit.
    """
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    mx, my, _ = lidar.mount
    first = theta + lidar.yaw + lidar.angle_min
    # the noise may bring a range that is just too long back into reach
    reach = lidar.range_max if noise is None else lidar.range_max + 6 * lidar.noise
    ranges = raycast(
        segments, discs, x + c * mx - s * my, y + s * mx + c * my, first, lidar.increment, lidar.beams, reach
    )
    return measured(lidar, ranges if noise is None else ranges + noise)


def measured(lidar: LidarModel, distances: Floats) -> Floats:
    """Distances (n,) as the laser tells them: inf beyond its reach, -inf if too close (REP 117)."""
    ranges = np.where(distances > lidar.range_max, np.inf, distances)
    ranges[distances < lidar.range_min] = -np.inf
    return ranges


def unmeasured(ranges: Floats, value: float = 0.0) -> Floats:
    """Ranges (n,) with `value` in place of what was not measured: 0.0, as a real LDS-01 has it."""
    return np.where(np.isfinite(ranges), ranges, value)
