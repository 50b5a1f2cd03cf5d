"""The module ``rospy.core``: log functions, the state of the node, shutdown."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from rosmini.core.errors import ROSException, RosminiError

from .logs import DEBUG, ERROR, FATAL, INFO, WARN, internally, once, plainly, throttled, throttled_identical
from .msproxy import SlaveProxy
from .names import get_caller_id, get_name
from .session import any_node, current_node, current_session

__all__ = [
    "ParameterInvalid",
    "add_client_shutdown_hook",
    "add_preshutdown_hook",
    "add_shutdown_hook",
    "get_caller_id",
    "get_name",
    "get_node_uri",
    "get_ros_root",
    "is_initialized",
    "is_shutdown",
    "is_shutdown_requested",
    "parse_rosrpc_uri",
    "signal_shutdown",
    "xmlrpcapi",
]

ROSRPC = "rosrpc://"

logdebug, loginfo, logwarn, logerr, logfatal = (plainly(level) for level in (DEBUG, INFO, WARN, ERROR, FATAL))
logdebug_once, loginfo_once, logwarn_once, logerr_once, logfatal_once = (
    once(level) for level in (DEBUG, INFO, WARN, ERROR, FATAL)
)
logdebug_throttle, loginfo_throttle, logwarn_throttle, logerr_throttle, logfatal_throttle = (
    throttled(level) for level in (DEBUG, INFO, WARN, ERROR, FATAL)
)
(
    logdebug_throttle_identical,
    loginfo_throttle_identical,
    logwarn_throttle_identical,
    logerr_throttle_identical,
    logfatal_throttle_identical,
) = (throttled_identical(level) for level in (DEBUG, INFO, WARN, ERROR, FATAL))
logout = loginfo
logerror = logerr
rospydebug, rospyinfo, rospywarn, rospyerr = (internally(level) for level in (DEBUG, INFO, WARN, ERROR))

TICKS_PER_POLL = 10
"""Ticks between checks, for a loop that only polls ``is_shutdown``: a turn takes a few microseconds."""


class ParameterInvalid(RosminiError):
    """An argument of a remote call is invalid."""


def parse_rosrpc_uri(uri: str) -> tuple[str, int]:
    """Split a service's URI, ``rosrpc://host:port``. Raises ``ParameterInvalid``."""
    host, colon, port = uri.removeprefix(ROSRPC).partition("/")[0].partition(":")
    if not uri.startswith(ROSRPC):
        raise ParameterInvalid(f"invalid protocol for a ROS service: {uri} does not start with {ROSRPC}")
    if not colon or not port.isdecimal():
        raise ParameterInvalid(f"invalid URI of a ROS service: {uri} is not {ROSRPC}host:port")
    return host, int(port)


def get_ros_root(required: bool = False, env: Any = None) -> str | None:
    """Return the environment's ``ROS_ROOT``, which is no longer used. Raises ``ROSException`` if ``required``."""
    found: str | None = (os.environ if env is None else env).get("ROS_ROOT")
    if required and found is None:
        raise ROSException("ROS_ROOT is not set")
    return found


def get_node_uri() -> str | None:
    """Return the URI of the node's slave API; None before ``init_node``."""
    node = current_node()
    return None if node is None else node.uri


def xmlrpcapi(uri: str | None, cache: bool = True) -> SlaveProxy | None:  # noqa: ARG001 - as in ROS
    """Return a proxy for the slave API of the node at ``uri``; None if it is not an http address."""
    return SlaveProxy(uri) if uri is not None and SlaveProxy.accepts(uri) else None


def is_initialized() -> bool:
    """Return True if the caller has a node."""
    return current_node() is not None


# -- the end -----------------------------------------------------------------------------------------------------


def is_shutdown() -> bool:
    """Return True if the node was shut down; False before ``init_node``."""
    node = current_node()
    if node is None:
        return current_session().is_shutdown()
    node.scheduler.tick(TICKS_PER_POLL)
    return node.is_shutdown()


def is_shutdown_requested() -> bool:
    """Return True if the shutdown has begun, including while the ``on_shutdown`` hooks run."""
    node = current_node()
    reason = current_session().shutdown_reason if node is None else node.shutdown_reason
    return reason is not None


def signal_shutdown(reason: str) -> None:
    """Shut the node down: ``on_shutdown`` hooks run first, then blocked calls end. May be called repeatedly."""
    session, node = current_session(), current_node()
    if node is None or node is session.node:
        session.shutdown(str(reason))
    else:
        node.shutdown(str(reason))


def add_client_shutdown_hook(h: Callable[[], object]) -> None:
    """Call ``h()`` when the node shuts down, while it can still publish; at once if it is already shut down.

    Raises ``TypeError`` if ``h`` cannot be called.
    """
    _check_hook(h)
    session, node = current_session(), current_node()
    if session.is_shutdown():
        any_node().guarded(h, what="rospy.on_shutdown")
    elif node is not None and node is not session.node:
        node.on_shutdown(h)
    else:
        session.arm()
        session.hooks.append(h)


def add_preshutdown_hook(h: Callable[[str], object]) -> None:
    """Call ``h(reason)`` when the node shuts down, after the hooks of ``on_shutdown``. Raises ``TypeError``."""
    _add_reasoned(h, current_session().preshutdown_hooks)


def add_shutdown_hook(h: Callable[[str], object]) -> None:
    """Call ``h(reason)`` when the node shuts down, after all other hooks. Raises ``TypeError``."""
    _add_reasoned(h, current_session().shutdown_hooks)


def _add_reasoned(h: Callable[[str], object], hooks: list[Callable[[str], object]]) -> None:
    _check_hook(h)
    session = current_session()
    if session.is_shutdown():
        any_node().guarded(h, "already shutdown", what="shutdown hook")
        return
    session.arm()
    hooks.append(h)


def _check_hook(h: Any) -> None:
    if not callable(h):
        raise TypeError(f"a shutdown hook must be a function or another callable object, not {h!r}")
