"""Gazebo on rosmini's engine: the server with its ROS services, plugins, and a client."""

from . import ros_plugins  # registers its plugins

__all__ = ["ros_plugins"]
