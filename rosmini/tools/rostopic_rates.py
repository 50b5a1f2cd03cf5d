"""Verbs of ``rostopic`` that measure: hz, delay, bw; once a second they print recent results."""

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
    from rosmini.core.verbs import Parser
    from rosmini.ros.introspection.rates import Arrivals, Statistics, Weight

BANDWIDTH_WINDOW = 100


def _subscribe(node: Node, topic: str, cls: Any, hear: Callable[[Any], object], *, raw: bool) -> None:
    """Subscribe to messages as in rospy, or as serialised bytes."""
    from rosmini.ros.rospy.msg import AnyMsg

    if raw:
        node.subscriber(topic, AnyMsg, hear, receipt=lambda _: AnyMsg.received)
    else:
        node.subscriber(topic, cls, hear, numpy=False)


def _one_topic(given: Values, usage: Parser) -> str:
    if not given.words:
        usage.error("topic must be specified")
    if len(given.words) > 1:
        usage.error("you may only specify one input topic")
    return global_name(given.words[0])


def _parser(verb: str, usage: str, description: str, example: str) -> Parser:
    parser = parser_of(f"{verb} {usage}", description, f"{verb} {example}")
    parser.add_option("-w", "--window", metavar="WINDOW", help="so many of the last messages count")
    add_duration(parser)
    return parser


def _window(given: Values, usage: Parser) -> int | None:
    return usage.whole(given.window, "window size must be an integer")


def _warn_of_simulated_time(node: Node, call: Call) -> None:
    if node.master.find("getParam", "/use_sim_time"):
        call.warn("WARNING: may be using simulated time")


# -- hz --------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Rates(Result):
    """Rates of messages on topics, as last printed; topics without messages are omitted."""

    topics: dict[str, Statistics]

    @property
    def hz(self) -> float | None:
        """Rate of the first topic [Hz]; None if fewer than two messages came."""
        return next((found.rate for found in self.topics.values()), None)


def hz_parser() -> Parser:
    """Return the parser of ``rostopic hz``."""
    usage = "[options] /topic_0 [/topic_1 [topic_2 [..]]]"
    parser = _parser("hz", usage, "Measure how often messages come.", "-w 100 /scan")
    parser.add_option("--filter", metavar="EXPR", help="only messages m for which this is true: m.data > 3")
    parser.flag("--wall-time", dest="wall_time", help="use wall-clock time, for a /clock that has stopped")
    return parser


def hz(given: Values, call: Call) -> Rates:
    """Measure the rate of messages."""
    from rosmini.ros.introspection.rates import Arrivals, rate_table, rate_text

    usage = hz_parser()
    if not given.words:
        usage.error("topic must be specified")
    window = _window(given, usage)
    holds = predicate(given.filter)
    span = Span.of(call.graph, duration_ns(given, call))
    heard: dict[str, Arrivals] = {}
    last: dict[str, Statistics] = {}
    problems: list[str] = []
    with tool_node(call.graph) as node:
        for name in map(global_name, given.words):
            found = await_topic(call, name, span)
            if found is None:
                return Rates(topics={})
            arrivals = heard[name] = Arrivals(-1 if window is None else window)
            hear = _counter(node, found.topic, arrivals, holds, problems, by_wall=given.wall_time)
            cls = None if holds is None else class_for(found, call.graph)
            _subscribe(node, found.topic, cls, hear, raw=holds is None)
            call.say(f"subscribed to [{found.topic}]")
        _warn_of_simulated_time(node, call)
        for _ in span.every(SECOND):
            if problems:
                raise VerbError(f"ERROR: --filter {given.filter!r}: {problems[0]}")
            news = {name: told for name, one in heard.items() if (told := one.statistics()) is not None}
            last.update(news)
            if not news:
                call.say("no new messages")
            else:
                call.say(rate_table(news) if len(heard) > 1 else rate_text(next(iter(news.values()))))
    return Rates(topics=last)


def _counter(
    node: Node,
    topic: str,
    arrivals: Arrivals,
    holds: Callable[[str, Any], bool] | None,
    problems: list[str],
    *,
    by_wall: bool,
) -> Callable[[Any], None]:
    from rosmini.core.expressions import ExpressionError

    def hear(message: Any) -> None:
        try:
            if holds is not None and not holds(topic, message):
                return
        except ExpressionError as error:
            problems.append(str(error))
            return
        arrivals.heard(node.scheduler.now_ns() if by_wall else node.now().to_nsec())

    return hear


# -- delay -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Delay(Result):
    """Age of messages on arrival [s]; None if no message came."""

    statistics: Statistics | None = None


def delay_parser() -> Parser:
    """Return the parser of ``rostopic delay``."""
    text = "Measure how old messages are when they come, by the stamps in their headers."
    return _parser("delay", "[options] /topic", text, "/scan")


def delay(given: Values, call: Call) -> Delay:
    """Measure the age of messages on arrival."""
    from rosmini.ros.introspection.rates import Delays, delay_text

    usage = delay_parser()
    name, window = _one_topic(given, usage), _window(given, usage)
    span = Span.of(call.graph, duration_ns(given, call))
    found = await_topic(call, name, span)
    if found is None:
        return Delay()
    delays = Delays(-1 if window is None else window)
    last = None
    with tool_node(call.graph) as node:

        def hear(message: Any) -> None:
            if not message._has_header:
                node.logerr("msg does not have header")
            else:
                delays.heard(node.now().to_nsec(), message.header.stamp.to_nsec())

        _subscribe(node, found.topic, class_for(found, call.graph), hear, raw=False)
        call.say(f"subscribed to [{found.topic}]")
        _warn_of_simulated_time(node, call)
        for _ in span.every(SECOND):
            told = delays.statistics()
            last = told or last
            if told is not None:
                call.say(delay_text(told))
            elif last is not None:
                call.say("no new messages")
    return Delay(statistics=last)


# -- bw --------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Bandwidth(Result):
    """Bandwidth; None if fewer than two messages came."""

    weight: Weight | None = None


def bw_parser() -> Parser:
    """Return the parser of ``rostopic bw``."""
    return _parser("bw", "/topic", "Measure how many bytes messages have.", "/camera/image")


def bw(given: Values, call: Call) -> Bandwidth:
    """Measure the bandwidth."""
    from rosmini.ros.introspection.rates import Sizes

    usage = bw_parser()
    name, window = _one_topic(given, usage), _window(given, usage)
    span = Span.of(call.graph, duration_ns(given, call))
    found = await_topic(call, name, span)
    if found is None:
        return Bandwidth()
    sizes = Sizes(max(window or BANDWIDTH_WINDOW, 0))
    now_ns = call.graph.scheduler.now_ns
    last = None
    with tool_node(call.graph) as node:

        def hear(message: Any) -> None:
            sizes.heard(now_ns() / 1e9, len(message._buff))  # noqa: SLF001 - rospy's name for the bytes

        _subscribe(node, found.topic, None, hear, raw=True)
        call.say(f"subscribed to [{found.topic}]")
        for _ in span.every(SECOND):
            told = sizes.weight(now_ns() / 1e9)
            last = told or last
            if told is not None:
                call.say(str(told))
    return Bandwidth(weight=last)
