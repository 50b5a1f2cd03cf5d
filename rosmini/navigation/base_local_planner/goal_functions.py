"""Functions for a plan and its goal, as in `base_local_planner/goal_functions.h`, but for arrays instead of messages.

They select the part of a plan in the local costmap, compare a pose with the goal, and detect a stopped robot.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.angles import shortest_angular_distance
from rosmini.core.geometry.poses import Pose
from rosmini.navigation.costmap_2d.costmap import Costmap2D

Floats = NDArray[np.float64]

PRUNE_DISTANCE = 1.0
"""The poses of a plan before the first one within this distance of the robot are pruned [m]."""


def slice_in_reach(plan: Floats, robot: Pose, grid: Costmap2D) -> slice:
    """Return the slice of a plan (n, 3) within the costmap's reach, which is half of its longer side.

    As in ROS it includes the first pose beyond. `robot` and `plan` must be in the same frame.
    """
    reach = max(grid.size_m) / 2
    near = ((plan[:, 0] - robot[0]) ** 2 + (plan[:, 1] - robot[1]) ** 2) <= reach * reach
    if not near.any():
        return slice(0, 0)
    first = int(np.argmax(near))
    beyond = np.flatnonzero(~near[first:])
    # ROS appends a pose before it measures its distance.
    return slice(first, first + int(beyond[0]) + 1 if len(beyond) else len(plan))


def passed_count(plan: Floats, robot: Pose) -> int:
    """Return the number of poses at the start of a plan (n, 3) that are not within `PRUNE_DISTANCE` of the robot."""
    near = ((plan[:, 0] - robot[0]) ** 2 + (plan[:, 1] - robot[1]) ** 2) < PRUNE_DISTANCE * PRUNE_DISTANCE
    return int(np.argmax(near)) if near.any() else len(plan)


def distance_to_goal(pose: Pose, goal: Pose) -> float:
    """Return the distance to the goal [m]."""
    return math.hypot(goal[0] - pose[0], goal[1] - pose[1])


def turn_to_goal(pose: Pose, goal: Pose) -> float:
    """Return the rotation from the pose's heading to the goal's, in (-pi, pi] [rad]."""
    return shortest_angular_distance(pose[2], goal[2])


def is_stopped(velocity: Floats, theta_stopped_vel: float, trans_stopped_vel: float) -> bool:
    """Return whether a velocity (3) counts as stopped: within the limits for turns [rad/s] and for each axis [m/s]."""
    return bool(
        abs(velocity[2]) <= theta_stopped_vel
        and abs(velocity[0]) <= trans_stopped_vel
        and abs(velocity[1]) <= trans_stopped_vel
    )
