"""The module that scripts import as ``dynamic_reconfigure``: http://wiki.ros.org/dynamic_reconfigure.

Names and signatures are those of dynamic_reconfigure 1.7; its modules ``client``, ``encoding`` and ``server`` are
all this one. The node is that of the script. The implementation is :mod:`rosmini.core.dynamic_reconfigure`.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from rosmini.core import dynamic_reconfigure
from rosmini.core.dynamic_reconfigure.description import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
)
from rosmini.core.dynamic_reconfigure.encoding import Config
from rosmini.msgs.dynamic_reconfigure import msg, srv
from rosmini.ros.rospy.aliases.rosgraph.masterapi import Master
from rosmini.ros.rospy.session import require_node

__all__ = [
    "Client",
    "Config",
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "Server",
    "extract_params",
    "find_reconfigure_services",
    "get_parameter_names",
    "msg",
    "srv",
]

client = encoding = server = sys.modules[__name__]

_SERVICE = "/set_parameters"


def find_reconfigure_services() -> list[str]:
    """Return the names of all servers, sorted, as ``Client`` takes them."""
    _, _, services = Master("/dynamic_reconfigure").getSystemState()
    return sorted(name.removesuffix(_SERVICE) for name, _ in services if name.endswith(_SERVICE))


def get_parameter_names(descr: Any) -> Any:
    """Return the parameter names of a description, such as the module that catkin generates from a ``.cfg`` file."""
    return descr.defaults.keys()


def extract_params(group: Any) -> list[Any]:
    """Return the parameters of a group's dictionary and of its ``groups``, a list or a dictionary."""
    inner = group["groups"]
    found = list(group["parameters"])
    for one in inner.values() if isinstance(inner, dict) else inner:
        found += extract_params(one)
    return found


class Server(dynamic_reconfigure.Server):
    """Provides the parameters that ``type`` describes. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(self, type: Any, callback: Callable[[Any, int], Any], namespace: str = "") -> None:
        super().__init__(require_node("a dynamic_reconfigure server"), type, callback, namespace)


class Client(dynamic_reconfigure.Client):
    """Changes the parameters of the server ``name``. Raises ``ROSInitException`` before ``init_node``."""

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: Callable[[Any], object] | None = None,
        description_callback: Callable[[Any], object] | None = None,
    ) -> None:
        node = require_node(f"a dynamic_reconfigure client of {name}")
        super().__init__(node, name, timeout, config_callback, description_callback)

    def get_config_callback(self) -> Callable[[Any], object] | None:
        """Return the callback for each new configuration: the attribute ``config_callback``."""
        return self.config_callback

    def set_config_callback(self, value: Callable[[Any], object] | None) -> None:
        """Set the callback for each new configuration."""
        self.config_callback = value

    def get_description_callback(self) -> Callable[[Any], object] | None:
        """Return the callback for each new description: the attribute ``description_callback``."""
        return self.description_callback

    def set_description_callback(self, value: Callable[[Any], object] | None) -> None:
        """Set the callback for each new description."""
        self.description_callback = value
