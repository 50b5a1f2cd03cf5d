"""The module that scripts import as ``tf2_sensor_msgs``: point clouds in another frame, by a given transform."""

from __future__ import annotations

from .tf2_sensor_msgs import create_cloud, do_transform_cloud, read_points

__all__ = ["create_cloud", "do_transform_cloud", "read_points"]
