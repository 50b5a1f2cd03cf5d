"""``rostopic pub``: publishes a message from YAML on the command line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import (
    IllegalName,
    MessageException,
    SerializationError,
    TypeMismatch,
    UnknownPackage,
    UnknownType,
)
from rosmini.core.verbs import SECOND, Call, Result, Span, VerbError, add_duration, duration_ns, global_name, tool_node

from .rostopic_list import parser_of
from .values import WrongYaml, fields_of, fill, parse

if TYPE_CHECKING:
    from optparse import Values

    from rosmini.core.graph import Node, Publisher
    from rosmini.core.time import Time
    from rosmini.core.verbs import Parser

ONCE_S = 3.0
"""How long a message published once remains available to late subscribers [s]."""


@dataclass(frozen=True, kw_only=True)
class Published(Result):
    """Number of messages published, and the last one."""

    count: int = 0
    message: Any = None


def pub_parser() -> Parser:
    """Return the parser of ``rostopic pub``."""
    example = "pub -r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'"
    text = "Publish messages. A value that begins with a minus sign comes after a lone --."
    parser = parser_of("pub /topic type [args...]", text, example)
    add = parser.add_option
    parser.flag("-v", dest="verbose", help="print what is published")
    add("-r", "--rate", metavar="RATE", help="so many messages a second")
    parser.flag("-1", "--once", dest="once", help="publish one message and end")
    parser.flag("-l", "--latch", dest="latch", help="with -r: latch, for late subscribers")
    parser.flag("-s", "--substitute-keywords", dest="substitute", help="with -r: fill in now and auto for each message")
    parser.flag("--use-rostime", dest="use_rostime", help="the time of /clock for now and auto, if there is one")
    add_duration(parser)
    return parser


class _Wish(NamedTuple):
    """Options of a command line."""

    topic: str
    type: str
    values: list[Any]
    rate: float | None


def _wish(given: Values) -> _Wish:
    usage = pub_parser()
    rate = None
    if given.rate is not None:
        if given.once:
            usage.error("You cannot select both -r and -1 (--once)")
        try:
            rate = float(given.rate)
        except ValueError:
            usage.error("rate must be a number")
        if not 0 < rate < float("inf"):
            usage.error("rate must be greater than zero")
    if not given.words:
        usage.error("/topic must be specified")
    if len(given.words) == 1:
        usage.error("topic type must be specified")
    topic, kind, *texts = given.words
    try:
        values = [parse(text) for text in texts]
    except WrongYaml as error:
        usage.error(f"Argument error: {error}")
    return _Wish(global_name(topic), kind, values, rate)


def pub(given: Values, call: Call) -> Published:
    """Publish messages."""
    wish = _wish(given)
    cls = _class_of(wish.type)
    if not wish.values and cls.__slots__:
        pub_parser().error(f"Please specify message values\nA {wish.type} has the fields: {fields_of(cls)}")
    with tool_node(call.graph) as node:
        try:
            publisher = node.publisher(wish.topic, cls, queue_size=100, latch=wish.rate is None or given.latch)
            return _Work(given, wish, call, node, publisher, cls).publish(wish.values)
        except SerializationError as error:
            raise VerbError(
                f"ERROR: Unable to publish message. One of the fields has an incorrect type:\n  {error}\n\n"
                f"msg file:\n{cls._full_text.partition(chr(10) + '====')[0].strip()}"
            ) from error
        except TypeMismatch as error:
            raise VerbError(f"ERROR: {error}") from error


def _class_of(kind: str) -> Any:
    """Return the class of a message type. Raises ``VerbError`` if it is unknown."""
    from rosmini.msgs import message_class

    try:
        return message_class(kind)
    except (UnknownType, UnknownPackage, IllegalName) as error:
        package = kind.partition("/")[0] if "/" in kind else None
        raise VerbError(
            f"ERROR: invalid message type: {kind}.\n"
            f"If this is a valid message type, perhaps you need to type 'rosmake {package}'\n{error}"
        ) from error


class _Work:
    """Publishes messages according to the options."""

    def __init__(self, given: Values, wish: _Wish, call: Call, node: Node, publisher: Publisher, cls: Any) -> None:
        self._given, self._call, self._node, self._publisher, self._class = given, call, node, publisher, cls
        self._rate = wish.rate
        if wish.rate is not None:
            publisher.expect_nobody()  # what is repeated will be heard
        self._count = 0

    def _span(self, duration_ns: int | None) -> Span:
        return Span.of(self._call.graph, duration_ns)

    def publish(self, values: list[Any]) -> Published:
        """Publish a message: once, latched, or repeatedly."""
        message = self._filled(self._class(), values)
        is_brief = self._given.once and self._given.duration is None
        duration = round(ONCE_S * SECOND) if is_brief else duration_ns(self._given, self._call)
        if self._rate is not None:
            self._repeat(message, values, self._rate, duration)
        else:
            what = f"publishing and latching [{message}]" if self._given.verbose else "publishing and latching message"
            self._call.say(what + (f" for {ONCE_S} seconds" if self._given.once else ". Press ctrl-C to terminate"))
            self._send(message)
            self._span(duration).wait(self._node, "Ctrl-C", lambda _: None)
        return Published(count=self._count, message=message)

    def _repeat(self, message: Any, values: list[Any], rate: float, duration: int | None) -> None:
        self._announce(message)
        self._send(message)
        for _ in self._span(duration).every(max(round(SECOND / rate), 1)):
            if self._node.is_shutdown():
                return
            if self._given.substitute:
                message = self._filled(message, values)
            self._announce(message)
            self._send(message)

    def _announce(self, message: Any) -> None:
        if self._given.verbose:
            self._call.say(f"publishing {message}")

    def _send(self, message: Any) -> None:
        self._publisher.publish(message)
        self._count += 1

    def _filled(self, message: Any, values: list[Any]) -> Any:
        """Return the message filled with values. Raises ``VerbError``."""
        try:
            fill(message, values, self._now())
        except (MessageException, ValueError) as error:
            raise VerbError(f"ERROR: {error}\n\nArgs are: [{fields_of(message)}]") from error
        return message

    def _now(self) -> Time:
        from rosmini.core.time import Time

        return self._node.now() if self._given.use_rostime else Time.from_nsec(self._node.scheduler.now_ns())
