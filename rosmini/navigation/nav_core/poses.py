"""Conversion between planar poses and messages."""

from __future__ import annotations

import math
from typing import Any

from rosmini.core.geometry.angles import quaternion_from_yaw, yaw_from_quaternion
from rosmini.core.geometry.poses import Pose
from rosmini.core.time import Time
from rosmini.msgs import message_class

from .failures import BadGoal

LENGTH_TOLERANCE = 0.1
"""Maximum deviation of a quaternion's squared length from 1, as in `move_base`."""

TILT_TOLERANCE = 1e-3
"""Maximum deviation of the rotated z axis from 1: `move_base` requires goals in the plane."""


def planar_pose(pose: Any) -> Pose:
    """Return x [m], y [m] and heading [rad] of a `geometry_msgs/Pose` or `PoseStamped`.

    Raises `GeometryError` if the length of the quaternion is 0 or not finite.
    """
    pose = getattr(pose, "pose", pose)
    p, q = pose.position, pose.orientation
    return p.x, p.y, yaw_from_quaternion(q.x, q.y, q.z, q.w)


def planar_transform(message: Any) -> Pose:
    """Return x [m], y [m] and heading [rad] of a `geometry_msgs/TransformStamped`.

    Raises `GeometryError` if the length of the quaternion is 0 or not finite.
    """
    t, q = message.transform.translation, message.transform.rotation
    return t.x, t.y, yaw_from_quaternion(q.x, q.y, q.z, q.w)


def pose_stamped(frame_id: str, stamp: Time, pose: Pose) -> Any:
    """Return a `geometry_msgs/PoseStamped` in the plane from x [m], y [m] and heading [rad]."""
    message = message_class("geometry_msgs/PoseStamped")()
    message.header.frame_id, message.header.stamp = frame_id, stamp
    message.pose.position.x, message.pose.position.y = pose[0], pose[1]
    q = message.pose.orientation
    q.x, q.y, q.z, q.w = quaternion_from_yaw(pose[2])
    return message


def checked_goal(goal: Any) -> Pose:
    """Return `planar_pose` of a goal (`PoseStamped`) from another node, after checking it.

    Raises `BadGoal` for numbers that are not finite, a quaternion whose length is not 1, and one that tilts the robot,
    with the messages of `move_base`.
    """
    p, q = goal.pose.position, goal.pose.orientation
    if not all(map(math.isfinite, (q.x, q.y, q.z, q.w))):
        raise BadGoal("Quaternion has nans or infs... discarding as a navigation goal", quaternion=_shown(q))
    if not all(map(math.isfinite, (p.x, p.y, p.z))):
        raise BadGoal(
            f"the goal's position is ({p.x}, {p.y}, {p.z}): it must be finite numbers, in metres", position=(p.x, p.y)
        )
    length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    if abs(length2 - 1.0) > LENGTH_TOLERANCE:
        hint = " (a message whose orientation was never set has w 0: set orientation.w = 1)" if length2 == 0 else ""
        raise BadGoal(
            f"Quaternion length is {math.sqrt(length2):.3f}, not 1{hint}... discarding as navigation goal",
            quaternion=_shown(q),
        )
    up = 1 - 2 * (q.x * q.x + q.y * q.y) / length2
    if abs(up - 1) > TILT_TOLERANCE:
        raise BadGoal(
            "Quaternion is invalid... for navigation the z-axis of the quaternion must be close to vertical: "
            f"this one tilts the robot by {math.degrees(math.acos(max(-1.0, min(1.0, up)))):.1f} degrees",
            quaternion=_shown(q),
        )
    return planar_pose(goal)


def _shown(q: Any) -> tuple[float, float, float, float]:
    return q.x, q.y, q.z, q.w
