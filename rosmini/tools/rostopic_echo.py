"""``rostopic echo``: prints messages or their fields as text or as comma-separated values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from rosmini.core.verbs import SECOND, Call, Result, Span, VerbError, add_duration, duration_ns, global_name, tool_node

from .listening import await_topic, class_for, predicate
from .rostopic_list import parser_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from optparse import Values

    from rosmini.core.graph import Node
    from rosmini.core.time import Time
    from rosmini.core.verbs import Parser

CLEAR = "\033[2J\033[;H"
"""Escape sequence that clears a terminal."""

NO_MESSAGES_NS = 2 * SECOND
"""Simulated time without messages after which a notice is printed [ns]."""


@dataclass(frozen=True, kw_only=True)
class Echoed(Result):
    """The received messages, or their requested fields, in order of arrival."""

    messages: tuple[Any, ...] = ()


def echo_parser() -> Parser:
    """Return the parser of ``rostopic echo``."""
    parser = parser_of("echo [options] /topic", "Print messages, or a field of them.", "echo -n 3 /scan/ranges[0:5]")
    add = parser.add_option
    parser.flag("-p", dest="plot", help="a line of comma-separated values for each, for programs that plot")
    add("-w", dest="width", metavar="NUM_WIDTH", help="so many characters for each number")
    add(
        "--filter",
        metavar="FILTER-EXPRESSION",
        help="only messages m for which this is true: m.pose.position.x > 0. It can compute and compare; it cannot "
        "import, open or change anything",
    )
    parser.flag("--nostr", dest="nostr", help="leave texts out")
    parser.flag("--noarr", dest="noarr", help="leave arrays out")
    parser.flag("-c", "--clear", dest="clear", help="clear the terminal before each message")
    add("-n", dest="count", metavar="COUNT", help="so many messages")
    parser.flag("--offset", dest="offset", help="times relative to the present [s]")
    add_duration(parser)
    return parser


@dataclass(frozen=True)
class _Options:
    """Options of a command line."""

    topic: str
    count: int | None
    width: int | None
    holds: Callable[[str, Any], bool] | None


def _options(given: Values) -> _Options:
    usage = echo_parser()
    if len(given.words) > 1:
        usage.error("you may only specify one input topic")
    if not given.words:
        usage.error("topic must be specified")
    width = usage.whole(given.width, "NUM_WIDTH must be an integer")
    if width is not None and not 2 <= width <= 100:
        usage.error("Fixed width for numeric values must be at least 2, and at most 100")
    count = usage.whole(given.count, "COUNT must be an integer")
    return _Options(global_name(given.words[0]), count, width, predicate(given.filter))


def echo(given: Values, call: Call) -> Echoed:
    """Print messages."""
    options = _options(given)
    span = Span.of(call.graph, duration_ns(given, call))
    found = await_topic(call, options.topic, span)
    if found is None:
        return Echoed()
    cls = class_for(found, call.graph)
    with tool_node(call.graph) as node:
        echoer = _Echo(given, options, call, node)
        echoer.look_at(found.type, found.path)
        node.subscriber(found.topic, cls, lambda message: echoer.hear(found.topic, message), numpy=False)
        if node.master.find("getParam", "/use_sim_time") and call.in_terminal:
            _warn_if_nothing_comes(echoer, span)
        span.wait(node, f"messages on {found.topic}", echoer.when_done)
    return echoer.result()


def _warn_if_nothing_comes(echoer: _Echo, span: Span) -> None:
    for _ in Span.of(span.graph, NO_MESSAGES_NS).every(SECOND // 10):
        if echoer.count or echoer.is_done:
            return
    echoer.call.warn("WARNING: no messages received and simulated time is active.\nIs /clock being published?")


class _Echo:
    """Prints messages according to the options."""

    def __init__(self, given: Values, options: _Options, call: Call, node: Node) -> None:
        from rosmini.ros.introspection.fields import chosen

        self.call = call
        self.count = 0
        self.is_done = options.count is not None and options.count <= 0
        self._given, self._options, self._node = given, options, node
        self._choose = chosen(strings=given.nostr, arrays=given.noarr)
        self._read: Callable[[Any], Any] = lambda message: message
        self._kind: str | None = None
        self._kept: list[Any] = []
        self._problem: Exception | None = None
        self._on_done: Callable[[], None] = lambda: None
        self._clear = CLEAR if given.clear and call.in_terminal else ""

    def look_at(self, kind: str, path: str) -> None:
        """Select the field at a path of messages of a type. Raises ``VerbError`` if they have no such field."""
        from rosmini.ros.introspection.fields import FieldError, field_type, reader

        try:
            self._read = reader(path)
        except FieldError as error:
            raise VerbError(f"{error}\nExamples: /scan/ranges[0], /scan/ranges[0:3], /odom/pose/pose") from error
        plain = "/".join(part.partition("[")[0] for part in path.split("/"))
        self._kind = field_type(kind, plain) if plain.strip("/") else None
        if self._kind is not None and path.rstrip("/").endswith("]"):
            self._kind = None if ":" not in path.rpartition("[")[2] else self._kind

    def when_done(self, on_done: Callable[[], None]) -> None:
        """Call ``on_done`` when no more messages are needed."""
        self._on_done = on_done
        if self.is_done:
            on_done()

    def result(self) -> Echoed:
        """Return the received messages. Raises ``VerbError`` if an error occurred."""
        if self._problem is not None:
            raise self._problem
        return Echoed(messages=tuple(self._kept))

    def hear(self, topic: str, message: Any) -> None:
        """Print a message if it is selected."""
        from rosmini.core.expressions import ExpressionError
        from rosmini.ros.introspection.fields import FieldError

        if self.is_done:
            return
        try:
            if self._options.holds is not None and not self._options.holds(topic, message):
                return
            value = self._read(message)
        except FieldError as error:
            self.call.warn(str(error))
            return
        except ExpressionError as error:
            self._end(VerbError(f"ERROR: --filter {self._given.filter!r}: {error}"))
            return
        self.count += 1
        try:
            self._print(value)
        except BrokenPipeError as error:  # the reader of the output, such as `head`, has ended
            self._end(error)
            return
        if not self.call.in_terminal:
            self._kept.append(value)
        if self._options.count is not None and self.count >= self._options.count:
            self._end(None)

    def _end(self, problem: Exception | None) -> None:
        self._problem = problem
        self.is_done = True
        self._on_done()

    def _print(self, value: Any) -> None:
        if not self._given.plot:
            self.call.say(f"{self._clear}{self._text(value)}\n---")
            return
        from rosmini.ros.introspection.fields import cells, title_line

        if self.count == 1:
            self.call.say(title_line(value, self._choose))
        when = value.header.stamp if getattr(type(value), "_has_header", False) else self._now()
        offset = self._now().to_nsec() if self._given.offset else 0
        self.call.say(f"{when.to_nsec() - offset},{','.join(cells(value, self._choose))}")

    def _text(self, value: Any) -> str:
        from rosmini.msgs.text import strify_message
        from rosmini.ros.introspection.fields import without

        if isinstance(value, bytes):
            value = list(value)
        if self._given.nostr or self._given.noarr:
            value = without(value, self._kind, strings=self._given.nostr, arrays=self._given.noarr)
        offset = self._now() if self._given.offset else None
        return strify_message(value, time_offset=offset, fixed_numeric_width=self._options.width)

    def _now(self) -> Time:
        return self._node.now()
