"""Parameters that can be changed while a node runs (http://wiki.ros.org/dynamic_reconfigure).

Clients and servers take a :class:`rosmini.core.graph.Node`. Scripts import the same classes in rospy's style as
``dynamic_reconfigure``: :mod:`rosmini.ros.rospy.aliases.dynamic_reconfigure`.
:mod:`~rosmini.core.dynamic_reconfigure.description` describes the parameters.
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
