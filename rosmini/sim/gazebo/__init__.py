"""Gazebo on rosmini's engine: the server with its ROS services, plugins, Gazebo's own topics, and a client."""

from __future__ import annotations

from .errors import GazeboError, SpawnError, UnknownEntity, UnknownPlugin
from .plugins import ModelPlugin, SensorPlugin, WorldPlugin, plugin_class, plugin_filenames
from .tags import Tags, tag
from .transport import Master, TransportNode

__all__ = [
    "GazeboError",
    "Master",
    "ModelPlugin",
    "SensorPlugin",
    "SpawnError",
    "Tags",
    "TransportNode",
    "UnknownEntity",
    "UnknownPlugin",
    "WorldPlugin",
    "plugin_class",
    "plugin_filenames",
    "tag",
]
