"""What the tools of rqt that look at messages have in common: a node of their own that listens for some time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.ros.introspection.fields import class_of
from rosmini.ros.introspection.topics import Found, look_up, what_next
from rosmini.viz.view import ViewError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph


def find_topic(graph: Graph, name: str) -> Found:
    """Return the topic that a name stands for, which may go on with fields.

    Raises:
        ViewError: there is no such topic or field, or its type is not known here; the message has the nearest.

    """
    full = name if name.startswith("/") else f"/{name}"
    found = look_up(graph, full)
    if found is None:
        raise ViewError(f"there is nothing to hear at {full}; {what_next(graph, full)}")
    if class_of(found.type) is None:
        raise ViewError(f"messages on {found.topic} are {found.type}, which no package here defines")
    return found


def listen(graph: Graph, tool: str, seconds: float, subscribe: Callable[[Any], None]) -> float:
    """Let graph time pass while a node hears what ``subscribe(node)`` subscribed it to; return when it began [s].

    Raises:
        ViewError: the duration is not positive.

    """
    if not 0 < seconds < float("inf"):
        raise ViewError(f"a duration is a positive number of seconds, not {seconds!r:.40}")
    node = graph.node(tool, anonymous=True)
    try:
        begin = graph.now().to_sec()
        subscribe(node)
        graph.run(seconds)
    finally:
        node.shutdown()
    return begin
