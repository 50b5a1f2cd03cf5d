"""``rosgraph.rosenv``: the address of the Master."""

from __future__ import annotations

import os
import sys
from typing import Any

from rosmini.core.graph import running_graph

ROS_MASTER_URI = "ROS_MASTER_URI"
ROS_NAMESPACE = "ROS_NAMESPACE"
ROS_HOSTNAME = "ROS_HOSTNAME"
ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"

DEFAULT_MASTER_PORT = 11311
DEFAULT_MASTER_URI = f"http://localhost:{DEFAULT_MASTER_PORT}/"


def get_master_uri(env: Any = None, argv: Any = None) -> str:
    """Return the URI from ``__master:=`` or ``ROS_MASTER_URI``, or else that of this graph's Master.

    Raises ``ValueError`` for ``__master:=`` without a URI.
    """
    for word in sys.argv if argv is None else argv:
        if word.startswith("__master:="):
            uri = word.removeprefix("__master:=")
            if not uri or ":=" in uri:
                raise ValueError(f"__master remapping argument '{word}' improperly specified")
            return str(uri)
    return (os.environ if env is None else env).get(ROS_MASTER_URI) or running_graph().master_uri
