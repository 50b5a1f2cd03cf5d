"""The nodes of `tf` and `tf2_ros`: `static_transform_publisher`, `tf_echo`, `tf_monitor`, `view_frames`."""

from __future__ import annotations
