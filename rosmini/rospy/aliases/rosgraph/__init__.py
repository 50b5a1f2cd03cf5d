"""What scripts import from ``rosgraph``: the Master and names."""

from __future__ import annotations

from rosmini.rospy.client import myargv

from . import masterapi, names, rosenv
from .masterapi import Master, MasterError, MasterException, MasterFailure
from .masterapi import is_online as is_master_online
from .rosenv import get_master_uri

__all__ = [
    "Master",
    "MasterError",
    "MasterException",
    "MasterFailure",
    "get_master_uri",
    "is_master_online",
    "masterapi",
    "myargv",
    "names",
    "rosenv",
]
