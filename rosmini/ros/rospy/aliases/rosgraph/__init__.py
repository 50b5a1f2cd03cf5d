"""The module that scripts import as ``rosgraph``: the Master and names."""

from __future__ import annotations

from rosmini.ros.rospy.client import myargv

from . import masterapi, names, rosenv
from .masterapi import Master, MasterError, MasterException, MasterFailure
from .masterapi import is_online as is_master_online
from .rosenv import ROS_HOSTNAME, ROS_IP, ROS_IPV6, ROS_MASTER_URI, ROS_NAMESPACE, get_master_uri

__all__ = [
    "ROS_HOSTNAME",
    "ROS_IP",
    "ROS_IPV6",
    "ROS_MASTER_URI",
    "ROS_NAMESPACE",
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
