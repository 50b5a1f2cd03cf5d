"""Shared functions of verbs on topics: waiting for a topic, its class, and a filter for its messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.verbs import SECOND, VerbError
from rosmini.ros.introspection.topics import look_up, what_next

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph
    from rosmini.core.verbs import Call, Span
    from rosmini.ros.introspection.topics import Found

POLL_PERIOD_NS = SECOND // 10
"""Period at which the Master is polled for a missing topic [ns]."""


def await_topic(call: Call, name: str, span: Span) -> Found | None:
    """Wait for the topic of a name and return it; None if it does not appear before the end."""
    found = look_up(call.peers, name)
    if found is not None:
        return found
    call.warn(f"WARNING: topic [{name}] does not appear to be published yet")
    call.warn(what_next(call.peers, name))
    for _ in span.every(POLL_PERIOD_NS):
        found = look_up(call.peers, name)
        if found is not None:
            return found
    return None


def class_for(found: Found, graph: Graph) -> Any:
    """Return the class with which to subscribe to a topic.

    For an unknown type it is ``AnyMsg``: each publisher in another process sends its definition. Raises
    ``VerbError`` if there is no such publisher.
    """
    from rosmini.ros.introspection.fields import class_of
    from rosmini.ros.rospy.msg import AnyMsg

    cls = class_of(found.type)
    if cls is None and not graph.master.is_local:
        return AnyMsg
    if cls is None:
        raise VerbError(
            f"ERROR: Cannot load message class for [{found.type}]. Are your messages built?\n"
            f"The package {found.type.partition('/')[0]} must be in a folder on ROS_PACKAGE_PATH, with "
            f"msg/{found.type.partition('/')[2]}.msg in it."
        )
    return cls


def predicate(text: str | None) -> Callable[[str, Any], bool] | None:
    """Return ``f(topic, message)`` for an expression of ``m`` and ``topic``. Raises ``VerbError`` if it is invalid.

    The function raises ``ExpressionError`` if the expression fails on a message.
    """
    from rosmini.core.expressions import ExpressionError
    from rosmini.ros.introspection.filters import message_expression

    if text is None:
        return None
    try:
        expression = message_expression(text, ("m", "topic"))
    except ExpressionError as error:
        example = "m.pose.position.x > 0"
        raise VerbError(f"ERROR: --filter {text!r}: {error}\nAn example: --filter {example!r}") from error
    return lambda topic, message: bool(expression.evaluate({"topic": topic, "m": message}))
