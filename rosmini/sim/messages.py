"""Common parts of the messages of several devices: frames, covariances, poses and transforms."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rosmini.core.geometry.poses import Pose
from rosmini.msgs import message_class
from rosmini.msgs.template import template

Floats = NDArray[np.float64]

ODOM, BASE, MAP, BASE_LINK = "odom", "base_footprint", "map", "base_link"
"""The frames of REP 105, and the one in the joint states of TurtleBot3's firmware."""

UNMEASURED = 1e12
POSE_COVARIANCE = (1e-5, 1e-5, UNMEASURED, UNMEASURED, UNMEASURED, 1e-3)
"""Variances of x, y, z and the rotations about them, as stated by Gazebo's differential drive.

The firmware leaves them at 0.
"""


def diagonal(values: Sequence[float]) -> Floats:
    """Return a matrix with these values on its diagonal, row by row, as messages contain covariances."""
    return np.diag(values).ravel()


ODOMETRY_FIELDS = (
    "pose.pose.position.x",
    "pose.pose.position.y",
    "pose.pose.orientation.z",
    "pose.pose.orientation.w",
    "twist.twist.linear.x",
    "twist.twist.linear.y",
    "twist.twist.angular.z",
)
"""The fields of `nav_msgs/Odometry` whose values `odometry_values` returns."""


def describe_odometry(message: Any, frame: str, child: str, covariance: Sequence[float]) -> None:
    """Fill in the fields that are the same in all messages of an odometry."""
    message.header.frame_id, message.child_frame_id = frame, child
    message.pose.covariance = message.twist.covariance = diagonal(covariance)


def odometry_values(pose: Pose, v: float, vy: float, w: float) -> tuple[float, ...]:
    """Return a pose, and the speeds ahead and to the left side [m/s] and to the left [rad/s], as `ODOMETRY_FIELDS`."""
    half = pose[2] / 2
    return (pose[0], pose[1], math.sin(half), math.cos(half), v, vy, w)


MakeTransform = Callable[[int, int, Pose], Any]
"""Makes a `geometry_msgs/TransformStamped` from seconds and nanoseconds, and the pose of the child."""


def moving_transform(frame: str, child: str) -> MakeTransform:
    """Return a function that makes the transforms from a frame to one that moves on the ground."""
    translation, rotation = "transform.translation", "transform.rotation"
    message = message_class("geometry_msgs/TransformStamped")(child_frame_id=child)
    message.header.frame_id = frame
    make = template(
        message,
        "header.stamp.secs",
        "header.stamp.nsecs",
        f"{translation}.x",
        f"{translation}.y",
        f"{rotation}.z",
        f"{rotation}.w",
    )

    def transform(secs: int, nsecs: int, pose: Pose) -> Any:
        half = pose[2] / 2
        return make(secs, nsecs, pose[0], pose[1], math.sin(half), math.cos(half))

    return transform


def fixed_transform(
    frame: str, child: str, place: Sequence[float], rotation: Sequence[float] = (0.0, 0.0, 0.0, 1.0)
) -> Callable[[int, int], Any]:
    """Return a function that makes the transforms, of any time, to a frame at a position [m] and a quaternion."""
    message: Any = message_class("geometry_msgs/TransformStamped")(child_frame_id=child)
    message.header.frame_id = frame
    to, turn = message.transform.translation, message.transform.rotation
    to.x, to.y, to.z = place
    turn.x, turn.y, turn.z, turn.w = rotation
    return template(message, "header.stamp.secs", "header.stamp.nsecs")
