"""``rostopic pub``: publishes messages from YAML on the command line, in a file or on standard input."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from itertools import chain
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
from .values import WrongYaml, documents_of, fields_of, fill, listed, parse, typed

if TYPE_CHECKING:
    from collections.abc import Iterator
    from optparse import Values

    from rosmini.core.graph import Node, Publisher
    from rosmini.core.time import Time
    from rosmini.core.verbs import Parser

ONCE_S = 3.0
"""How long a message published once remains available to late subscribers [s]."""

SUBSCRIBER_S = 5.0
"""How long to wait for a subscriber before publishing messages from a file or standard input [s]."""

RATE_HZ = 10.0
"""Rate of publishing messages from a file or standard input [Hz]."""


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
    add("-r", "--rate", metavar="RATE", help="so many messages a second (10 from a file or standard input)")
    parser.flag("-1", "--once", dest="once", help="publish one message and end")
    add("-f", "--file", metavar="FILE", help="messages from a YAML file, with --- between them")
    parser.flag("-l", "--latch", dest="latch", help="with -r, -f or standard input: latch, for late subscribers")
    parser.flag("-s", "--substitute-keywords", dest="substitute", help="with -r: fill in now and auto each time anew")
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
    if texts and given.file:
        usage.error("args conflict with -f setting")
    try:
        values = [parse(text) for text in texts]
    except WrongYaml as error:
        usage.error(f"Argument error: {error}")
    return _Wish(global_name(topic), kind, values, rate)


def pub(given: Values, call: Call) -> Published:
    """Publish messages."""
    wish = _wish(given)
    cls = _class_of(wish.type)
    if not wish.values and cls.__slots__ and not given.file and (call.read_line is None or sys.stdin.isatty()):
        pub_parser().error(f"Please specify message values\nA {wish.type} has the fields: {fields_of(cls)}")
    with tool_node(call.graph) as node:
        try:
            publisher = node.publisher(wish.topic, cls, queue_size=100, latch=wish.rate is None or given.latch)
            work = _Work(given, wish, call, node, publisher, cls)
            if wish.values or not cls.__slots__:
                return work.publish_one(wish.values)
            return work.publish_all(_in_file(given.file) if given.file else typed(call))
        except SerializationError as error:
            raise VerbError(
                f"ERROR: Unable to publish message. One of the fields has an incorrect type:\n  {error}\n\n"
                f"msg file:\n{cls._full_text.partition(chr(10) + '====')[0].strip()}"
            ) from error
        except (TypeMismatch, WrongYaml) as error:
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


def _in_file(path: str) -> Iterator[Any]:
    """Yield the documents of a YAML file. Raises ``VerbError``."""
    from pathlib import Path

    if not Path(path).is_file():
        raise VerbError(f"ERROR: file does not exist: {path}")
    try:
        yield from documents_of(Path(path).read_text(encoding="utf-8"), path)
    except WrongYaml as error:
        raise VerbError(f"ERROR: invalid YAML in file: {error}") from error
    except UnicodeDecodeError as error:
        raise VerbError(f"ERROR: invalid YAML in file: {path} is not UTF-8 text") from error


class _Work:
    """Publishes messages according to the options."""

    def __init__(self, given: Values, wish: _Wish, call: Call, node: Node, publisher: Publisher, cls: Any) -> None:
        self._given, self._call, self._node, self._publisher, self._class = given, call, node, publisher, cls
        self._rate = wish.rate
        if wish.rate is not None:
            publisher.expect_nobody()  # what is repeated will be heard
        self._count = 0
        self._last: Any = None

    def _span(self, duration_ns: int | None) -> Span:
        return Span.of(self._call.graph, duration_ns)

    def _result(self) -> Published:
        return Published(count=self._count, message=self._last)

    def publish_one(self, values: list[Any]) -> Published:
        """Publish one message: once, latched, or repeatedly."""
        message = self._filled(self._class(), values)
        is_brief = self._given.once and self._given.duration is None
        duration = round(ONCE_S * SECOND) if is_brief else duration_ns(self._given, self._call)
        if self._rate is not None:
            self._repeat(message, values, self._rate, duration)
            return self._result()
        self._say_latched(message, brief=self._given.once)
        self._send(message)
        self._stay(duration)
        return self._result()

    def publish_all(self, messages: Iterator[Any]) -> Published:
        """Publish the messages of a file or of standard input one after another."""
        rate = self._rate
        if rate is None and not self._given.latch and not self._given.once:
            rate = RATE_HZ
        self._await_subscriber()
        if self._given.file and rate is not None:
            first, second = next(messages, None), next(messages, None)
            if first is not None and second is None:
                self._call.say("Got one message and a rate, publishing repeatedly")
                values = listed(first)
                message = self._filled(self._class(), values)
                self._repeat(message, values, rate, duration_ns(self._given, self._call))
                return self._result()
            messages = chain((first, second), messages)
        for value in messages:
            if value is None or self._node.is_shutdown():
                continue
            message = self._filled(self._class(), listed(value))
            self._say_latched(message, brief=rate is not None or self._given.once)
            self._send(message)
            if self._given.once:
                self._stay(round(ONCE_S * SECOND))
                break
            self._stay(duration_ns(self._given, self._call) if rate is None else round(SECOND / rate))
        return self._result()

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

    def _say_latched(self, message: Any, *, brief: bool) -> None:
        what = f"publishing and latching [{message}]" if self._given.verbose else "publishing and latching message"
        self._call.say(what + (f" for {ONCE_S} seconds" if brief else ". Press ctrl-C to terminate"))

    def _send(self, message: Any) -> None:
        self._publisher.publish(message)
        self._count += 1
        self._last = message

    def _stay(self, duration: int | None) -> None:
        self._span(duration).wait(self._node, "Ctrl-C", lambda _: None)

    def _await_subscriber(self) -> None:
        for _ in self._span(round(SUBSCRIBER_S * SECOND)).every(SECOND // 100):
            if self._publisher.num_connections():
                return

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
