"""What scripts import as ``dynamic_reconfigure``: http://wiki.ros.org/dynamic_reconfigure.

Names and signatures are those of dynamic_reconfigure 1.7; the node is that of the script. The work is done in
:mod:`rosmini.dynamic_reconfigure`.
"""

from __future__ import annotations

from rosmini.dynamic_reconfigure.errors import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureException,
    DynamicReconfigureParameterException,
)
from rosmini.msgs.dynamic_reconfigure import msg, srv

from . import client, encoding, server

__all__ = [
    "DynamicReconfigureCallbackException",
    "DynamicReconfigureException",
    "DynamicReconfigureParameterException",
    "client",
    "encoding",
    "msg",
    "server",
    "srv",
]
