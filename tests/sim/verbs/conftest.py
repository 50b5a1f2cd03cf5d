"""A running Gazebo for the verbs."""

from ..gazebo.conftest import bench

__all__ = ["bench"]
