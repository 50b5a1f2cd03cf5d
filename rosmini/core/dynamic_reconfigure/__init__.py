"""Parameters that are changed while a node runs (http://wiki.ros.org/dynamic_reconfigure).

The object API, on a :class:`rosmini.core.graph.Node`. What scripts import as ``dynamic_reconfigure`` is the same in
rospy's style, :mod:`rosmini.ros.rospy.aliases.dynamic_reconfigure`. What can be changed is described in
:mod:`~rosmini.core.dynamic_reconfigure.description`.
"""

from __future__ import annotations

from .client import Client
from .description import (
    Description,
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
    ParameterGroup,
    ReconfigurableParameter,
)
from .encoding import Config
from .server import Server

__all__ = [
    "Client",
    "Config",
    "Description",
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "ParameterGroup",
    "ReconfigurableParameter",
    "Server",
]
