"""``tf2_sensor_msgs``, and its module of the same name: transforms point clouds with a given transform."""

from __future__ import annotations

import sys

from rosmini.core.tf.messages import transformed
from rosmini.ros.rospy.aliases.point_cloud2 import create_cloud, read_points

do_transform_cloud = transformed

__all__ = ["create_cloud", "do_transform_cloud", "read_points"]

tf2_sensor_msgs = sys.modules[__name__]
