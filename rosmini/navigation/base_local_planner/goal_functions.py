"""The part of a plan that concerns the local planner, and whether its end is reached: `goal_functions`, on arrays."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.geometry.poses import Pose
from rosmini.navigation.costmap_2d.costmap import Costmap2D

Floats = NDArray[np.float64]

BEHIND = 1.0
"""What lies further behind is pruned, up to the first point that does not [m]."""


def part_in_reach(plan: Floats, robot: Pose, grid: Costmap2D) -> slice:
    """Which poses of a plan (n, 3) are in reach of the costmap, half its longer side: from the first one that is.

    The one after the last of them belongs to it, too, as in ROS. `robot` and `plan` are in one frame.
    """
    reach = max(grid.size_m) / 2
    near = ((plan[:, 0] - robot[0]) ** 2 + (plan[:, 1] - robot[1]) ** 2) <= reach * reach
    if not near.any():
        return slice(0, 0)
    first = int(np.argmax(near))
    beyond = np.flatnonzero(~near[first:])
    # ROS measures a pose after it has put it in.
    return slice(first, first + int(beyond[0]) + 1 if len(beyond) else len(plan))


def behind(plan: Floats, robot: Pose) -> int:
    """How many poses at the beginning of a plan (n, 3) lie more than `BEHIND` away from the robot: what is pruned."""
    near = ((plan[:, 0] - robot[0]) ** 2 + (plan[:, 1] - robot[1]) ** 2) < BEHIND * BEHIND
    return int(np.argmax(near)) if near.any() else len(plan)


def distance_to(pose: Pose, goal: Pose) -> float:
    """How far the goal is [m]."""
    return math.hypot(goal[0] - pose[0], goal[1] - pose[1])


def turn_to(pose: Pose, goal: Pose) -> float:
    """By how much to turn at the goal, in (-pi, pi] [rad]."""
    return shortest_angular_distance(pose[2], goal[2])


def stands(velocity: Floats, theta_stopped_vel: float, trans_stopped_vel: float) -> bool:
    """Whether a velocity (3) counts as standing."""
    return bool(
        abs(velocity[2]) <= theta_stopped_vel
        and abs(velocity[0]) <= trans_stopped_vel
        and abs(velocity[1]) <= trans_stopped_vel
    )
