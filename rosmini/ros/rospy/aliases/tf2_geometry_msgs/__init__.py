"""``tf2_geometry_msgs``, and its module of the same name: transforms stamped geometry with a given transform."""

from __future__ import annotations

import sys
from typing import Any

from rosmini.msgs import message_class
from rosmini.ros.rospy.aliases.tf2_ros.buffer_interface import moved

PointStamped = message_class("geometry_msgs/PointStamped")
PoseStamped = message_class("geometry_msgs/PoseStamped")
PoseWithCovarianceStamped = message_class("geometry_msgs/PoseWithCovarianceStamped")
TransformStamped = message_class("geometry_msgs/TransformStamped")
Vector3Stamped = message_class("geometry_msgs/Vector3Stamped")
WrenchStamped = message_class("geometry_msgs/WrenchStamped")

do_transform_point = moved
do_transform_vector3 = moved
do_transform_pose = moved
do_transform_pose_with_covariance_stamped = moved
do_transform_wrench = moved


def to_msg_msg(msg: Any) -> Any:
    """Return the message itself: it is a message already."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """Return the message itself."""
    return msg


__all__ = [
    "PointStamped",
    "PoseStamped",
    "PoseWithCovarianceStamped",
    "TransformStamped",
    "Vector3Stamped",
    "WrenchStamped",
    "do_transform_point",
    "do_transform_pose",
    "do_transform_pose_with_covariance_stamped",
    "do_transform_vector3",
    "do_transform_wrench",
    "from_msg_msg",
    "to_msg_msg",
]

tf2_geometry_msgs = sys.modules[__name__]
