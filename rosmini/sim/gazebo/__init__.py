"""Gazebo on rosmini's engine: the server with its ROS services, plugins, and a client."""

from __future__ import annotations

from . import ros_plugins  # registers its plugins
from .client import GazeboClient
from .errors import GazeboError, SpawnError, UnknownEntity, UnknownPlugin
from .plugin_tags import Tags, tag
from .plugins import ModelPlugin, SensorPlugin, WorldPlugin, plugin_class, plugin_filenames
from .server import Gazebo, GazeboServer
from .topics import GazeboMaster

__all__ = [
    "Gazebo",
    "GazeboClient",
    "GazeboError",
    "GazeboMaster",
    "GazeboServer",
    "ModelPlugin",
    "SensorPlugin",
    "SpawnError",
    "Tags",
    "UnknownEntity",
    "UnknownPlugin",
    "WorldPlugin",
    "plugin_class",
    "plugin_filenames",
    "ros_plugins",
    "tag",
]
