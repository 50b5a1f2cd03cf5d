"""`rqt_topic`: the topics of a graph with their types, bandwidths, rates and values (http://wiki.ros.org/rqt_topic)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from io import BytesIO
from optparse import Values
from typing import Any

from rosmini.core.errors import nearest
from rosmini.core.graph import Graph
from rosmini.core.graph.subscription import Subscriber
from rosmini.core.verbs import Call
from rosmini.msgs.message import Message
from rosmini.ros.introspection.fields import class_of
from rosmini.ros.introspection.rates import Arrivals, Sizes
from rosmini.ros.introspection.topics import types
from rosmini.viz.view import View, ViewError
from rosmini.viz.words import plural

from .panel import Panel, each_of, pass_time
from .parts import Control, Part, Row, Rows, without_controls
from .table import Table

MAX_LENGTH = 60
"""Maximum number of characters of a value."""
MAX_ELEMENTS = 5
"""Maximum number of elements of an array of messages."""
WINDOW, LONG_WINDOW = 100, 10_000
"""Number of messages from which a panel and a still compute rate and bandwidth."""


def rqt_topic(graph: Graph, *, expand: Collection[str] = (), duration: float = 2.0, title: str = "rqt_topic") -> Table:
    """Listen to all topics for ``duration`` seconds of graph time, and show their rates, bandwidths and values.

    Args:
        graph: the graph, which runs meanwhile.
        expand: topics to show with the last value of each field.
        duration: how long to listen [s].
        title: the caption.

    Raises:
        ViewError: the duration is not positive.

    """
    known = known_topics(graph)
    with TopicMonitor.alone(graph, *known, window=LONG_WINDOW) as monitor:
        pass_time(graph, duration)
        return Table(without_controls(monitor.table(expand)), title=title, noun="topic")


def known_topics(graph: Graph) -> dict[str, str]:
    """Return the topics of known types, sorted, and their types."""
    return {name: kind for name, kind in sorted(types(graph)) if class_of(kind) is not None}


class Heard:
    """Rate, bandwidth and last message of a topic, computed from the last ``window`` messages."""

    def __init__(self, window: int) -> None:
        self.last: Any = None
        self._sizes = Sizes(window)
        self._arrivals = Arrivals(window)

    def hear(self, now_ns: int, message: Any) -> None:
        """Count a message that came at a time [ns]."""
        message.serialize(written := BytesIO())
        self._sizes.heard(now_ns / 1e9, len(written.getvalue()))
        self._arrivals.heard(now_ns)
        self.last = message

    def figures(self, now: float) -> tuple[str, str]:
        """Return bandwidth and rate at a time [s]; ``unknown`` if too few messages came since the last call."""
        weight, rate = self._sizes.weight(now), self._arrivals.statistics()
        return f"{_bytes(weight.rate)}/s" if weight else "unknown", f"{rate.rate:.2f}" if rate else "unknown"


def _bytes(count: float) -> str:
    for unit in ("B", "KB"):
        if count < 1000:
            return f"{count:.2f}{unit}"
        count /= 1000
    return f"{count:.2f}MB"


def fields_of(message: Any, depth: int = 1) -> Iterator[tuple[int, str, str, str]]:
    """Yield depth, name, type and value of every field; the fields of a nested message follow it."""
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        value = getattr(message, name)
        if isinstance(value, Message):
            yield depth, name, kind, ""
            yield from fields_of(value, depth + 1)
        elif isinstance(value, list | tuple) and value and isinstance(value[0], Message):
            yield depth, name, kind, plural(len(value), "element")
            for number, one in enumerate(value[:MAX_ELEMENTS]):
                yield depth + 1, f"[{number}]", kind.partition("[")[0], ""
                yield from fields_of(one, depth + 2)
        else:
            yield depth, name, kind, value_text(value)


def value_text(value: Any) -> str:
    """Return the value of a field in one short line."""
    if hasattr(value, "to_sec"):
        return f"{value.to_sec():.3f}"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple | bytes) and len(value) > MAX_ELEMENTS:
        head = ", ".join(value_text(one) for one in value[:MAX_ELEMENTS])
        return f"({head}, ...), {len(value)} elements"
    text = repr(value) if isinstance(value, str | bytes) else str(value)
    return text if len(text) <= MAX_LENGTH else f"{text[: MAX_LENGTH - 3]}..."


FIGURES_S = 1.0
"""Interval between updates of rates and bandwidths [s]."""


class TopicMonitor(Panel):
    """All topics; a ticked topic is shown with its rate, bandwidth and the last value of each field.

    Args:
        graph: the graph.
        topics: topics ticked at first.
        name: name of the panel's node.

    Raises:
        ViewError: there is no such topic.

    """

    tool, heading, plugin = "rqt_topic", "Topic Monitor", "rqt_topic/TopicPlugin"
    group, summary = ("Topics", "topics with types, bandwidths and rates, and the values of those that are named")
    usage, takes, example, listen_s = "[TOPIC...]", "topic", "/odom", 2.0

    def __init__(self, graph: Graph, *topics: str, name: str | None = None, window: int = WINDOW) -> None:
        super().__init__(graph, name=name)
        self._window = window
        self._heard: dict[str, tuple[Heard, Subscriber]] = {}
        self._figures: dict[str, tuple[float, tuple[str, str]]] = {}
        for topic in topics:
            self.hear(topic)

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Listen to all topics, and show the last values of the named ones."""
        words, _ = cls.arguments(given)
        return rqt_topic(call.graph, expand=words, duration=given.duration, title=given.title or cls.tool)

    @property
    def topics(self) -> tuple[str, ...]:
        """The ticked topics."""
        return tuple(self._heard)

    def hear(self, topic: str, on: bool = True) -> None:
        """Start or stop listening to a topic. Raises ``ViewError`` for an unknown topic."""
        self._require()
        if not on:
            if topic in self._heard:
                self._heard.pop(topic)[1].unregister()
            return
        known = known_topics(self.graph)
        if topic not in known:
            raise ViewError(f"there is no topic {topic!r:.80}; {nearest(topic, known) or '`rostopic list` lists all'}")
        if topic not in self._heard:
            one = Heard(self._window)
            graph = self.graph
            subscriber = self.node.subscriber(
                topic, class_of(known[topic]), lambda message: one.hear(graph.now().to_nsec(), message), numpy=False
            )
            self._heard[topic] = (one, subscriber)

    def parts(self) -> Sequence[Part]:
        """The table."""
        return [self.table(self._heard)]

    def table(self, expand: Collection[str]) -> Rows:
        """Return a row for each topic, followed by a row for each field if the topic is in ``expand``."""
        now = self.graph.now().to_sec()
        rows: list[Row] = []
        for topic, kind in known_topics(self.graph).items():
            tick = Control(f"hear/{topic}", f"hear {topic}", "check", topic in self._heard)
            one = self._heard[topic][0] if topic in self._heard else None
            figures = ("", "") if one is None else self._worked_out(topic, one, now)
            rows.append(Row((topic, tick, kind, *figures, "not heard" if one and one.last is None else "")))
            if one is not None and one.last is not None and topic in expand:
                rows += [
                    Row((name, "", kind, "", "", value), depth) for depth, name, kind, value in fields_of(one.last)
                ]
        return Rows(("Topic", "Hear", "Type", "Bandwidth", "Hz", "Value"), tuple(rows), "Topics", "no topics")

    def _worked_out(self, topic: str, one: Heard, now: float) -> tuple[str, str]:
        before = self._figures.get(topic)
        if before is None or abs(now - before[0]) >= FIGURES_S:
            before = self._figures[topic] = (now, one.figures(now))
        return before[1]

    def settings(self) -> dict[str, Any]:
        """Return the ticked topics."""
        return {"topics": list(self._heard)}

    def restore(self, settings: dict[str, Any]) -> None:
        """Tick the topics of a perspective; one error names all that fail."""
        each_of(self.hear, settings.get("topics", []))

    def _operate(self, key: Sequence[str], value: Any) -> None:
        self.hear("/".join(key[1:]), value)
