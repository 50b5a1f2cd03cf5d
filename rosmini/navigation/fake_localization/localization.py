"""Where odom stands in the map, from where a robot really is and where its odometry believes it to be."""

from __future__ import annotations

from rosmini.core.tf.rigid import Rigid, compose, from_yaw, inverse


def offset(delta_x: float, delta_y: float, delta_yaw: float) -> Rigid:
    """What is put before each true pose, for a map whose origin lies at the deltas [m, rad] in the truth's frame.

    As in the original the deltas are taken off one by one, and not as a transform.
    """
    return from_yaw(-delta_x, -delta_y, -delta_yaw)


def odom_in_map(base_in_map: Rigid, base_in_odom: Rigid) -> Rigid:
    """The transform from map to odom that makes both true."""
    return compose(base_in_map, inverse(base_in_odom))


def moved_offset(before: Rigid, wanted: Rigid, base_in_map: Rigid) -> Rigid:
    """The offset with which the robot, now believed to be at `base_in_map`, is at `wanted`."""
    return compose(compose(wanted, inverse(base_in_map)), before)
