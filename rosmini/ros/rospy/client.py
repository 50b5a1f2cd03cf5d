"""``rospy.init_node`` and what is around it: http://wiki.ros.org/rospy/Overview/Initialization%20and%20Shutdown."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from rosmini.core import time as base
from rosmini.core.errors import IllegalName, ROSException, ROSInitException, ROSInterruptException
from rosmini.core.graph import Node
from rosmini.core.graph.rosout import NAMES
from rosmini.core.names import Remappings

from .core import add_client_shutdown_hook
from .logs import DEBUG, ERROR, FATAL, INFO, WARN
from .msproxy import MasterProxy, published_topics
from .session import Session, answer_interrupt, any_node, current_node, current_session, require_node
from .topics import check_message_class, receipt_of, registered_class, resolve_early

__all__ = [
    "DEBUG",
    "ERROR",
    "FATAL",
    "INFO",
    "WARN",
    "delete_param",
    "get_master",
    "get_param",
    "get_param_cached",
    "get_param_names",
    "get_published_topics",
    "has_param",
    "init_node",
    "myargv",
    "on_shutdown",
    "search_param",
    "set_param",
    "spin",
    "wait_for_message",
]


class _Unspecified:
    def __repr__(self) -> str:
        return "(none)"


_unspecified = _Unspecified()


class _Arguments(NamedTuple):
    """The arguments of ``init_node`` that must be the same in a second call."""

    name: str
    argv: list[str]
    anonymous: bool
    log_level: int | None
    disable_rostime: bool
    disable_signals: bool


def myargv(argv: Sequence[str] | None = None) -> list[str]:
    """Return the arguments without ROS's remappings; ``sys.argv`` by default."""
    return Remappings.other_arguments(sys.argv if argv is None else argv)


# -- the node ----------------------------------------------------------------------------------------------------


def init_node(
    name: str,
    argv: Sequence[str] | None = None,
    anonymous: bool = False,
    log_level: int | None = None,
    disable_rostime: bool = False,
    disable_rosout: bool = False,  # noqa: ARG001 - rospy's signature
    disable_signals: bool = False,
    xmlrpc_port: int = 0,  # noqa: ARG001
    tcpros_port: int = 0,  # noqa: ARG001
) -> None:
    """Start the node of this script, or of this program or notebook, and register it with the Master.

    Args:
        name: its base name, without '/'.
        argv: command-line arguments with remappings; ``sys.argv`` by default.
        anonymous: append a number to the name, so that one script can start many nodes.
        log_level: lowest level that is logged: ``rospy.DEBUG`` ... ``rospy.FATAL``.
        disable_rostime: accepted for compatibility; without effect, like all that follow.
        disable_rosout: without effect.
        disable_signals: without effect.
        xmlrpc_port: without effect.
        tcpros_port: without effect.

    A second call with the same arguments does nothing. Raises ``ValueError`` for an illegal name and ``ROSException``
    for a second call with other arguments: one script is one node.

    """
    session = current_session()
    _check_name(name)
    if argv is not None:
        session.given_argv = list(argv)
    arguments = _Arguments(name, list(session.argv()), anonymous, log_level, disable_rostime, disable_signals)
    if session.is_main and session.node is not None and session.node.is_shutdown():
        session.restart()
    if session.arguments is not None:
        if session.arguments[0] == name and session.arguments == arguments:
            return
        raise ROSException(_second_call(session, arguments))
    if session.shutdown_reason is not None:
        raise ROSInitException(
            f"init_node({name!r}) after the shutdown ({session.shutdown_reason}): it is too late for a node"
        )
    if log_level is not None and log_level not in NAMES:
        raise ValueError(f"log_level is one of rospy.DEBUG, INFO, WARN, ERROR and FATAL, not {log_level!r}")
    node = _start(session, arguments)
    session.arguments = arguments
    if log_level is not None:
        node.logger.set_level("rosout", NAMES[log_level])
    pending, session.pending = session.pending, []
    for register in pending:
        register(node)


def _start(session: Session, arguments: _Arguments) -> Node:
    node = Node(
        arguments.name,
        session.graph,
        namespace=session.namespace(),
        remappings=session.remappings(),
        anonymous=arguments.anonymous,
        context=session.context,
    )
    session.node = node
    session.graph.scheduler.current().node = node
    if session.is_main:
        session.graph.scheduler.root.node = node
    else:
        _introduce(session.context, node)
    node.on_shutdown(session.run_hooks)
    session.arm()
    return node


def _introduce(context: Any, node: Node) -> None:
    """Tell the script's runner about its node."""
    context.node = node
    node.process = getattr(context, "process", None)
    set_node_name: Callable[[str], object] | None = getattr(context, "set_node_name", None)
    if set_node_name is not None:
        set_node_name(node.name)


def _check_name(name: Any) -> None:
    if not isinstance(name, str) or not name:
        raise IllegalName(f"name must not be empty: init_node() takes a node's name, such as 'talker', not {name!r}")
    if "/" in name:
        raise IllegalName(
            f"namespaces are not allowed in node names: {name!r}. "
            "Give the name alone, and the namespace with __ns:= on the command line or ns= in a launch file."
        )


def _second_call(session: Session, arguments: _Arguments) -> str:
    before = _Arguments(*session.arguments) if session.arguments else arguments
    how = (
        "For more nodes in one program use the object API, rosmini.Node('name'), or end this one with "
        "rospy.signal_shutdown('')."
        if session.is_main
        else "One script is one node: run a second script for a second node."
    )
    differ = [name for name in _Arguments.__annotations__ if getattr(before, name) != getattr(arguments, name)]
    was, now = (", ".join(f"{name}={getattr(given, name)!r}" for name in differ) for given in (before, arguments))
    return f"rospy.init_node() has already been called with different arguments: {was}, now {now}. {how}"


def spin() -> None:
    """Block until the node is shut down, while callbacks run.

    Raises ``ROSInitException`` before ``init_node``, and ``ROSException`` in a normal notebook cell, which would
    never end.
    """
    node, session = current_node(), current_session()
    if session.is_main and session.graph.notebook:
        raise ROSException(
            "rospy.spin() never returns, so a plain cell cannot call it. A script that spins needs a separate cell, "
            "which begins with %%node NAME.py; in a plain cell rosmini.wait(3) lets callbacks run for three seconds"
        )
    if node is None:
        if session.is_shutdown():
            return
        raise ROSInitException(
            "client code must call rospy.init_node() first: without a node rospy.spin() has nothing to wait for"
        )
    try:
        node.spin()
    except KeyboardInterrupt as error:
        if isinstance(answer_interrupt(node, error), ROSInterruptException):
            return
        raise


def on_shutdown(h: Callable[[], object]) -> None:
    """Call ``h()`` when the node shuts down, while it can still publish; at once if it is already shut down.

    Raises ``TypeError``.
    """
    add_client_shutdown_hook(h)


def get_master(env: Any = None) -> MasterProxy:  # noqa: ARG001 - rospy's signature; there is one Master here
    """Return the Master's API."""
    return MasterProxy(any_node().graph.master_uri)


def get_published_topics(namespace: str = "/") -> list[list[str]]:
    """Return ``[topic, type]`` pairs of the published topics under ``namespace``."""
    return published_topics(namespace)


def wait_for_message(topic: str, topic_type: Any, timeout: float | base.Duration | None = None) -> Any:
    """Block until a message arrives on ``topic`` and return it.

    Raises ``ROSException`` after ``timeout`` seconds, ``ROSInterruptException`` at shutdown, ``ROSInitException``
    before ``init_node`` and ``ValueError`` for an invalid name or message class.
    """
    node = require_node(f"waiting for a message on {topic}")
    check_message_class(topic_type)
    name = resolve_early(topic, "topic")
    if node.is_shutdown():
        raise ROSInterruptException(f"waiting for a message on {name}: node {node.name} was shut down")
    waiter = node.waiter(f"a message on {name}")
    subscriber = node.subscriber(
        topic, registered_class(topic_type), waiter.wake, numpy=False, receipt=receipt_of(topic_type)
    )
    limit = timeout.to_sec() if isinstance(timeout, base.Duration) else timeout
    try:
        if not node.wait(waiter, limit):
            raise ROSException(
                f"timeout exceeded while waiting for message on topic {name}: nothing came in {limit:g} s; "
                f"{node.master.who_publishes(name)}"
            )
    except KeyboardInterrupt as error:
        raise answer_interrupt(node, error) from None
    finally:
        subscriber.unregister()
    return waiter.value


# -- parameters --------------------------------------------------------------------------------------------------


def get_param(param_name: str, default: Any = _unspecified) -> Any:
    """Return a parameter's value, or ``default`` if it is not set; a namespace is a dictionary.

    Bytes are returned as an ``xmlrpc.client.Binary``, as in rospy. Raises ``KeyError``.
    """
    node = any_node()
    found = node.get_param(param_name) if default is _unspecified else node.get_param(param_name, default)
    return _with_binaries(found)


def _with_binaries(value: Any) -> Any:
    if isinstance(value, bytes):
        from xmlrpc.client import Binary

        return Binary(value)
    if isinstance(value, dict):
        return {key: _with_binaries(each) for key, each in value.items()}
    return [_with_binaries(each) for each in value] if isinstance(value, list) else value


def get_param_cached(param_name: str, default: Any = _unspecified) -> Any:
    """Return what ``get_param`` returns: the Parameter Server is so fast that no cache is needed.

    Raises ``KeyError``.
    """
    return get_param(param_name, default)


def get_param_names() -> list[str]:
    """Return the names of all parameters."""
    return any_node().param_names()


def set_param(param_name: str, param_value: Any) -> None:
    """Set a parameter; a dictionary sets a whole tree. Raises ``ParameterError`` for a value that ROS cannot store."""
    any_node().set_param(param_name, param_value)


def search_param(param_name: str) -> str | None:
    """Return the full name of the nearest parameter with this name upwards from the node, or None."""
    return get_master().search_param(param_name)


def delete_param(param_name: str) -> None:
    """Delete a parameter or a tree. Raises ``KeyError``."""
    any_node().delete_param(param_name)


def has_param(param_name: str) -> bool:
    """Return True if a parameter, or a tree of them, is set."""
    return any_node().has_param(param_name)
