"""``rosgraph.rosenv``: where the Master is."""

from __future__ import annotations

from typing import Any

from rosmini.graph import running_graph

ROS_MASTER_URI = "ROS_MASTER_URI"
ROS_NAMESPACE = "ROS_NAMESPACE"
ROS_HOSTNAME = "ROS_HOSTNAME"
ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"

DEFAULT_MASTER_PORT = 11311
DEFAULT_MASTER_URI = f"http://localhost:{DEFAULT_MASTER_PORT}/"


def get_master_uri(env: Any = None, argv: Any = None) -> str:  # noqa: ARG001 - rosgraph's signature
    """Return the URI of this process's Master."""
    return running_graph().master_uri
