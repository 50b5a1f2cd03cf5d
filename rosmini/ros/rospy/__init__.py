"""The module that scripts import as ``rospy``: http://wiki.ros.org/rospy.

Names, signatures and behaviour are those of rospy 1.15 (Noetic). The lane that makes a call determines the node, see
:mod:`rosmini.ros.rospy.session`; so several scripts, each with its node, run in one process. After
:func:`rosmini.install` a program or a notebook can ``import rospy``; scripts run by rosmini always can.
"""

from __future__ import annotations

from typing import Any

from rosmini.core import errors as exceptions
from rosmini.core.errors import (
    ROSException,
    ROSInitException,
    ROSInternalException,
    ROSInterruptException,
    ROSSerializationException,
    ROSTimeMovedBackwardsException,
    ServiceException,
    TransportException,
    TransportInitError,
    TransportTerminated,
    nearest,
)
from rosmini.msgs import message_class

from . import core, names, rostime, timer, topics
from .client import (
    DEBUG,
    ERROR,
    FATAL,
    INFO,
    WARN,
    delete_param,
    get_master,
    get_param,
    get_param_cached,
    get_param_names,
    get_published_topics,
    has_param,
    init_node,
    myargv,
    on_shutdown,
    search_param,
    set_param,
    spin,
    wait_for_message,
)
from .core import (
    get_node_uri,
    get_ros_root,
    is_shutdown,
    logdebug,
    logdebug_once,
    logdebug_throttle,
    logdebug_throttle_identical,
    logerr,
    logerr_once,
    logerr_throttle,
    logerr_throttle_identical,
    logfatal,
    logfatal_once,
    logfatal_throttle,
    logfatal_throttle_identical,
    loginfo,
    loginfo_once,
    loginfo_throttle,
    loginfo_throttle_identical,
    logout,
    logwarn,
    logwarn_once,
    logwarn_throttle,
    logwarn_throttle_identical,
    parse_rosrpc_uri,
    signal_shutdown,
)
from .importer import install, modules, uninstall
from .msg import AnyMsg
from .msproxy import MasterProxy
from .names import get_caller_id, get_name, get_namespace, remap_name, resolve_name
from .rostime import Duration, Time, get_rostime, get_time
from .service import Service, ServiceProxy, wait_for_service
from .timer import Rate, Timer, sleep
from .topics import Message, Publisher, SubscribeListener, Subscriber

Header = message_class("std_msgs/Header")

__all__ = [
    "DEBUG",
    "ERROR",
    "FATAL",
    "INFO",
    "WARN",
    "AnyMsg",
    "Duration",
    "Header",
    "MasterProxy",
    "Message",
    "Publisher",
    "ROSException",
    "ROSInitException",
    "ROSInternalException",
    "ROSInterruptException",
    "ROSSerializationException",
    "ROSTimeMovedBackwardsException",
    "Rate",
    "Service",
    "ServiceException",
    "ServiceProxy",
    "SubscribeListener",
    "Subscriber",
    "Time",
    "Timer",
    "TransportException",
    "TransportInitError",
    "TransportTerminated",
    "delete_param",
    "exceptions",
    "get_caller_id",
    "get_master",
    "get_name",
    "get_namespace",
    "get_node_uri",
    "get_param",
    "get_param_cached",
    "get_param_names",
    "get_published_topics",
    "get_ros_root",
    "get_rostime",
    "get_time",
    "has_param",
    "init_node",
    "install",
    "is_shutdown",
    "logdebug",
    "logdebug_once",
    "logdebug_throttle",
    "logdebug_throttle_identical",
    "logerr",
    "logerr_once",
    "logerr_throttle",
    "logerr_throttle_identical",
    "logfatal",
    "logfatal_once",
    "logfatal_throttle",
    "logfatal_throttle_identical",
    "loginfo",
    "loginfo_once",
    "loginfo_throttle",
    "loginfo_throttle_identical",
    "logout",
    "logwarn",
    "logwarn_once",
    "logwarn_throttle",
    "logwarn_throttle_identical",
    "modules",
    "myargv",
    "on_shutdown",
    "parse_rosrpc_uri",
    "remap_name",
    "resolve_name",
    "search_param",
    "set_param",
    "signal_shutdown",
    "sleep",
    "spin",
    "uninstall",
    "wait_for_message",
    "wait_for_service",
]


def __getattr__(name: str) -> Any:
    """Raise an error that says where rospy has a name that is missing here, or suggests a similar one."""
    if name.startswith("__"):
        raise AttributeError(f"module 'rospy' has no attribute '{name}'", name=name)
    if name == "impl":
        hint = "that is the inside of the real one, its sockets and threads, of which there are none here"
    else:
        homes = [part.__name__ for part in (core, names, rostime, timer, topics) if hasattr(part, name)]
        hint = (
            f"it is rospy.{homes[0].rpartition('.')[2]}.{name}"
            if homes
            else nearest(name, __all__) or "the real one has none either"
        )
    raise AttributeError(f"module 'rospy' has no attribute '{name}': {hint}", name=name)
