"""``roslib.scriptutil``: the Master and names, for scripts older than ``rosgraph``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rosmini.core.graph import running_graph
from rosmini.core.graph.master_port import METHODS

from . import names


def script_resolve_name(script_name: str, name: str) -> str:
    """Return the global name of ``name`` for a script of this name in ``ROS_NAMESPACE``."""
    if not name:
        return names.get_ros_namespace()
    if names.is_global(name):
        return name
    if names.is_private(name):
        return names.ns_join(names.make_caller_id(script_name), name[1:])
    return names.get_ros_namespace() + name


class _Master:
    """The Master API: ``getSystemState("/caller")`` returns [code, status, value]."""

    def __getattr__(self, name: str) -> Callable[..., list[Any]]:
        if name not in METHODS:
            raise AttributeError(f"the Master has no method {name}", name=name, obj=self)
        return lambda caller_id, *arguments: list(running_graph().ask_as(caller_id).call(name, *arguments))


def get_master() -> _Master:
    """Return an object that calls the Master API."""
    return _Master()


def get_param_server() -> _Master:
    """Return an object that calls the Parameter Server API, which the Master provides."""
    return get_master()
