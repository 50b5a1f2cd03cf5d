"""What scripts import as ``dynamic_reconfigure``: http://wiki.ros.org/dynamic_reconfigure.

Names and signatures are those of dynamic_reconfigure 1.7; the node is that of the script. The work is done in
:mod:`rosmini.dynamic_reconfigure`.
"""

from __future__ import annotations

from typing import Any

from rosmini.dynamic_reconfigure.errors import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
)
from rosmini.msgs.dynamic_reconfigure import msg, srv
from rosmini.rospy.aliases.rosgraph.masterapi import Master

from . import client, encoding, server

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "client",
    "encoding",
    "find_reconfigure_services",
    "get_parameter_names",
    "msg",
    "server",
    "srv",
]

_SERVICE = "/set_parameters"


def find_reconfigure_services() -> list[str]:
    """Return the names of all servers, sorted: those that a ``Client`` takes."""
    _, _, services = Master("/dynamic_reconfigure").getSystemState()
    return sorted(name.removesuffix(_SERVICE) for name, _ in services if name.endswith(_SERVICE))


def get_parameter_names(descr: Any) -> Any:
    """Return the names of the parameters of a description, such as the module that catkin makes of a ``.cfg`` file."""
    return descr.defaults.keys()
