"""A running Gazebo for the verbs."""

from __future__ import annotations

from ..gazebo.conftest import bench

__all__ = ["bench"]
