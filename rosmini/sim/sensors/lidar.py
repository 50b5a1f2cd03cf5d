"""A laser: from what stands around to the ranges of a `sensor_msgs/LaserScan`.

Beam i looks at the angle angle_min + i increment, counter-clockwise from where the laser looks, and measures the
distance to the first thing in its way plus Gaussian noise. A laser that turns has beams all around: angle_min is 0, and
the increment 2 pi / n. What it cannot measure follows REP 117 (https://www.ros.org/reps/rep-0117.html), as in Gazebo:
inf where nothing is within reach, -inf where something is too close. A real LDS-01 sends 0 for what it cannot measure,
and its driver, `hls_lfcd_lds_driver`, passes that on; `unmeasured` makes this form of ours.

A real LDS-01 takes 0.2 s for a scan, while the robot moves on: a message of a robot that turns is bent. The simulator's
laser sweeps likewise, see `rosmini.sim.engine.sweep`, and its messages are laid out as those of the driver
(`hlds_laser_publisher`, 1.1.2, the last one for Noetic): the mirror goes round clockwise, the driver writes ranges from
the last one measured to the first, so that angles increase, and it takes the stamp when all have come in. So the stamp
is the time of `ranges[0]`, straight ahead, and `ranges[i]` is older by i / 1800 s. We say so with a negative
`time_increment`, -1/1800 s, which stamp + i time_increment then is true for; the driver writes 0.00003 s there, too
little and of the wrong sign (https://github.com/ROBOTIS-GIT/turtlebot3/issues/634). In Stage and Gazebo, and with
`_sweep:=false`, all beams are measured at one moment, and it is 0.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.core.geometry.raycast import raycast
from rosmini.sim.models import LidarModel

Floats = NDArray[np.float64]


def scan(
    lidar: LidarModel, pose: Pose, segments: Floats, discs: Floats, noise: Floats | None = None
) -> Floats:
    """The ranges (beams,) [m] that the laser of a robot at `pose` measures.

    `segments` (n, 4) and `discs` (m, 3) are what is as high as the laser, in the world's frame; `noise` (beams,) is
    added to what is hit.
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
