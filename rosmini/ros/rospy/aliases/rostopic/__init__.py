"""The module that scripts import as ``rostopic`` (http://wiki.ros.org/rostopic): types, rates, publishers by name."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import MasterUnreachable, MessageException, RosminiError
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import topics
from rosmini.ros.introspection.fields import FieldError, chosen, class_of, reader
from rosmini.ros.rospy.aliases.genpy.message import fill_message_args, get_printable_message_args
from rosmini.ros.rospy.aliases.rosgraph.names import script_resolve_name
from rosmini.ros.rospy.mains import run_tool

from .echoing import CallbackEcho
from .measures import ROSTopicBandwidth, ROSTopicDelay, ROSTopicHz

__all__ = [
    "NAME",
    "CallbackEcho",
    "ROSTopicBandwidth",
    "ROSTopicDelay",
    "ROSTopicException",
    "ROSTopicHz",
    "ROSTopicIOException",
    "create_field_filter",
    "create_publisher",
    "find_by_type",
    "get_api",
    "get_info_text",
    "get_topic_class",
    "get_topic_list",
    "get_topic_type",
    "msgevalgen",
    "publish_message",
    "rostopicmain",
]

NAME = "rostopic"
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


def _check_master() -> None:
    """Raise ``ROSTopicIOException`` if there is no Master; scripts use this private function of rostopic."""
    with _no_master():
        running_graph().ask_as(topics.ID).ask("getPid")


def _master_get_topic_types(master: Any) -> list[list[str]]:  # noqa: ARG001 - as in ROS
    with _no_master():
        return [list(pair) for pair in topics.types(running_graph())]


def _get_topic_type(topic: str) -> Found:
    return get_topic_type(topic)


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


def get_api(master: Any, caller_id: str) -> str:  # noqa: ARG001 - as in ROS
    """Return the address of a node's slave API, or a text that says that it is unknown."""
    with _no_master():
        return topics.addresses(running_graph(), [caller_id])[caller_id]


def get_info_text(topic: str) -> str:
    """Return the output of ``rostopic info``. Raises ``ROSTopicException`` for an unknown topic."""
    with _no_master():
        found = topics.about(running_graph(), topic)
    if found is None:
        raise ROSTopicException(f"Unknown topic {topic}")
    return str(found)


def create_field_filter(echo_nostr: bool, echo_noarr: bool) -> Callable[[Any], Any]:
    """Return a function that returns the fields of a message without strings, or without arrays."""
    return chosen(strings=echo_nostr, arrays=echo_noarr)


def create_publisher(topic_name: str, topic_type: str, latch: bool, disable_rostime: bool = True) -> tuple[Any, Any]:
    """Return a ``rospy.Publisher`` for a topic with the type's name, and the class; calls init_node if needed.

    Raises ``ROSTopicException`` for an unknown type.
    """
    from rosmini.ros.rospy import Publisher, init_node
    from rosmini.ros.rospy.session import current_node

    cls = class_of(topic_type)
    if cls is None:
        package = topic_type.partition("/")[0] if "/" in topic_type else None
        raise ROSTopicException(
            f"invalid message type: {topic_type}.\nIf this is a valid message type, perhaps you need to type "
            f"'rosmake {package}'"
        )
    if current_node() is None:
        init_node(NAME, anonymous=True, disable_rosout=True, disable_rostime=disable_rostime)
    return Publisher(script_resolve_name(NAME, topic_name), cls, latch=latch, queue_size=100), cls


def publish_message(
    pub: Any,
    msg_class: Any,
    pub_args: list[Any],
    rate: float | None = None,
    once: bool = False,
    verbose: bool = False,
    substitute_keywords: bool = False,
) -> None:
    """Fill a message from plain values and publish it: at a rate, once, or latched until the node shuts down.

    Raises ``ROSTopicException`` for invalid values.
    """
    from rosmini.ros.rospy import Rate, is_shutdown, spin

    message = _filled(msg_class(), pub_args)
    if rate is None:
        what = f"publishing and latching [{message}]" if verbose else "publishing and latching message"
        print(what + (" for 3.0 seconds" if once else ". Press ctrl-C to terminate"))
        pub.publish(message)
        if not once:
            spin()
        return
    keep = Rate(rate)
    while not is_shutdown():
        if substitute_keywords:
            message = _filled(message, pub_args)
        if verbose:
            print(f"publishing {message}")
        pub.publish(message)
        keep.sleep()


def _filled(message: Any, values: Any) -> Any:
    from rosmini.msgs.std_msgs.msg import Header
    from rosmini.ros.rospy.rostime import get_rostime

    now = get_rostime()
    try:
        fill_message_args(message, values, {"now": now, "auto": Header(stamp=now)})
    except MessageException as error:
        raise ROSTopicException(f"{error}\n\nArgs are: [{get_printable_message_args(message)}]") from error
    return message


def rostopicmain(argv: Sequence[str] | None = None) -> None:
    """Run a rostopic command line, ``sys.argv`` if None; raise ``SystemExit`` if it fails."""
    run_tool("rostopic", argv)
