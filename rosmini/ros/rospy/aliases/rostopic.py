"""The module that scripts import as ``rostopic`` (http://wiki.ros.org/rostopic): topics, their types and classes."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import MasterUnreachable, RosminiError
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import topics
from rosmini.ros.introspection.fields import FieldError, class_of, reader

__all__ = [
    "ROSTopicException",
    "ROSTopicIOException",
    "find_by_type",
    "get_topic_class",
    "get_topic_list",
    "get_topic_type",
    "msgevalgen",
]

POLL_PERIOD_NS = 100_000_000
"""Period at which the Master is polled for a missing topic [ns]."""

Found = tuple[str, str, Callable[[Any], Any] | None] | tuple[None, None, None]


class ROSTopicException(RosminiError):
    """Base class of rostopic's errors."""


class ROSTopicIOException(ROSTopicException):
    """The Master does not answer."""


@contextmanager
def _no_master() -> Iterator[None]:
    try:
        yield
    except MasterUnreachable as error:
        raise ROSTopicIOException(f"Unable to communicate with master! {error}") from error


def msgevalgen(pattern: str) -> Callable[[Any], Any] | None:
    """Return a function that reads the fields at a path, such as ``/x[2:]/y``, from a message.

    None for an empty path, and for an invalid one, with a message on stderr. If a message lacks the field, there is
    a message too, and the function returns None.
    """
    if not pattern.strip("/"):
        return None
    try:
        read = reader(pattern)
    except FieldError as error:
        print(error, file=sys.stderr)
        return None

    def evaluate(message: Any) -> Any:
        try:
            return read(message)
        except FieldError as error:
            print(error, file=sys.stderr)
            return None

    return evaluate


def get_topic_type(topic: str, blocking: bool = False) -> Found:
    """Return type and name of a topic, and a function that reads the field in the name; three times None if unknown.

    ``blocking`` waits until the topic exists. Raises ``ROSTopicIOException`` if the Master does not answer.
    """
    graph = running_graph()
    with _no_master():
        found = topics.look_up(graph, topic)
        if found is None and blocking:
            sys.stderr.write(f"WARNING: topic [{topic}] does not appear to be published yet\n")
            while found is None:
                graph.scheduler.sleep_until(graph.scheduler.now_ns() + POLL_PERIOD_NS, f"the topic {topic}")
                found = topics.look_up(graph, topic)
    return (None, None, None) if found is None else (found.type, found.topic, msgevalgen(found.path))


def get_topic_class(topic: str, blocking: bool = False) -> tuple[Any, str | None, Callable[[Any], Any] | None]:
    """Return the message class of a topic, its name, and a function that reads the field: see :func:`get_topic_type`.

    Raises ``ROSTopicException`` for an unknown type.
    """
    kind, name, evaluate = get_topic_type(topic, blocking)
    if kind is None:
        return None, None, None
    cls = class_of(kind)
    if cls is None:
        raise ROSTopicException(f"Cannot load message class for [{kind}]. Are your messages built?")
    return cls, name, evaluate


def get_topic_list(master: Any = None) -> tuple[list[tuple[str, str, list[str]]], ...]:  # noqa: ARG001 - as in ROS
    """Return the published topics and those with subscribers: lists of (name, type, nodes)."""
    with _no_master():
        found = topics.topics(running_graph())
    return tuple([(each.name, each.type, list(each.nodes)) for each in side] for side in found)


def find_by_type(topic_type: str) -> list[str]:
    """Return the topics of a type."""
    with _no_master():
        return topics.by_type(running_graph(), topic_type)
