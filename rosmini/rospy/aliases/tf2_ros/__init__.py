"""The module that scripts import as ``tf2_ros`` (http://wiki.ros.org/tf2_ros): buffer, listener and broadcasters of the script's node."""

from __future__ import annotations

from typing import Any

from rosmini.tf.buffer import BufferCore
from rosmini.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from . import (
    buffer,
    buffer_client,
    buffer_interface,
    buffer_server,
    static_transform_broadcaster,
    transform_broadcaster,
    transform_listener,
)
from .buffer import Buffer
from .buffer_client import BufferClient
from .buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from .buffer_server import BufferServer
from .static_transform_broadcaster import StaticTransformBroadcaster
from .transform_broadcaster import TransformBroadcaster
from .transform_listener import TransformListener

__all__ = [
    "Buffer",
    "BufferClient",
    "BufferCore",
    "BufferInterface",
    "BufferServer",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TypeException",
    "buffer",
    "buffer_client",
    "buffer_interface",
    "buffer_server",
    "convert",
    "static_transform_broadcaster",
    "transform_broadcaster",
    "transform_listener",
]

_TYPES = {
    "Header": "std_msgs/Header",
    "LookupTransformAction": "tf2_msgs/LookupTransformAction",
    "LookupTransformGoal": "tf2_msgs/LookupTransformGoal",
    "TFMessage": "tf2_msgs/TFMessage",
    "TransformStamped": "geometry_msgs/TransformStamped",
}


def __getattr__(name: str) -> Any:
    """Scripts get message types through this module too: ``tf2_ros.TransformStamped``."""
    if name in _TYPES:
        from rosmini.msgs import message_class

        return message_class(_TYPES[name])
    raise AttributeError(f"module 'tf2_ros' has no attribute {name!r}")
