"""The pose of odom in the map, from the robot's true pose and its pose in the odometry frame."""

from __future__ import annotations

from rosmini.core.tf.rigid import Rigid, compose, from_yaw, inverse


def offset(delta_x: float, delta_y: float, delta_yaw: float) -> Rigid:
    """Return the offset applied to true poses, for a map whose origin is at the deltas [m, rad] in the truth's frame.

    As in the original each delta is subtracted separately, instead of inverting a transform.
    """
    return from_yaw(-delta_x, -delta_y, -delta_yaw)


def odom_in_map(base_in_map: Rigid, base_in_odom: Rigid) -> Rigid:
    """Return the pose of odom in the map that is consistent with both poses of the robot."""
    return compose(base_in_map, inverse(base_in_odom))


def moved_offset(before: Rigid, target: Rigid, base_in_map: Rigid) -> Rigid:
    """Return the offset that places the robot, now estimated at `base_in_map`, at `target`."""
    return compose(compose(target, inverse(base_in_map)), before)
