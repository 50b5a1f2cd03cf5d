"""A laser: from the surroundings to the ranges of a `sensor_msgs/LaserScan`.

Beam i points to the angle angle_min + i increment, counter-clockwise from the laser's forward direction, and measures
the distance to the first object in its way plus Gaussian noise. A rotating laser covers the full circle: angle_min is 0
and the increment 2 pi / n. Invalid ranges follow REP 117 (https://www.ros.org/reps/rep-0117.html), as in Gazebo:
inf if nothing is within reach, -inf if an object is too close. A real LDS-01 sends 0 for both cases,
and its driver, `hls_lfcd_lds_driver`, passes that on; `unmeasured` converts ours to this form.

A real LDS-01 takes 0.2 s for a scan, while the robot moves on: the scan of a turning robot is distorted. Our
laser sweeps likewise, see `rosmini.sim.engine.sweep`, and its messages have the layout of the driver
(`hlds_laser_publisher`, 1.1.2, the last one for Noetic): the mirror rotates clockwise, the driver writes ranges from
the last one measured to the first, so that angles increase, and takes the stamp when all have arrived. So the stamp
is the time of `ranges[0]`, straight ahead, and `ranges[i]` is older by i / 1800 s. We publish this as a negative
`time_increment`, -1/1800 s, so that stamp + i time_increment is right; the driver writes 0.00003 s, which is too
small and has the wrong sign (https://github.com/ROBOTIS-GIT/turtlebot3/issues/634). In Stage and Gazebo, and with
`_sweep:=false`, all beams are measured at one moment, and `time_increment` is 0.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.sim.geometry.raycast import raycast
from rosmini.sim.models import LidarModel

Floats = NDArray[np.float64]


def scan(lidar: LidarModel, pose: Pose, segments: Floats, discs: Floats, noise: Floats | None = None) -> Floats:
    """Return the ranges (beams,) [m] that the laser of a robot at `pose` measures.

    `segments` (n, 4) and `discs` (m, 3) are the objects at the laser's height in the world's frame; `noise` (beams,) is
    added to measured distances.
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
    """Return distances (n,) as the laser reports them: inf beyond its reach, -inf if too close (REP 117)."""
    ranges = np.where(distances > lidar.range_max, np.inf, distances)
    ranges[distances < lidar.range_min] = -np.inf
    return ranges


def unmeasured(ranges: Floats, value: float = 0.0) -> Floats:
    """Return ranges (n,) with `value` instead of inf and -inf: 0.0, as a real LDS-01 does."""
    return np.where(np.isfinite(ranges), ranges, value)
