"""`rqt_topic` that goes on: topics with rates, bandwidths and values (http://wiki.ros.org/rqt_topic)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.core.errors import nearest
from rosmini.ros.introspection.fields import class_of
from rosmini.viz.rqt.topics import Heard, fields_of, known_topics
from rosmini.viz.view import ViewError

from .panel import Panel, each_of
from .parts import Control, Row, Rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.core.graph import Graph
    from rosmini.core.graph.subscriber import Subscriber

    from .parts import Part

WINDOW = 100
"""How many messages rate and bandwidth are of."""
FIGURES_S = 1.0
"""How often rates and bandwidths are worked out [s]."""


class TopicMonitor(Panel):
    """All topics; those that are ticked are heard, and shown with rate, bandwidth and the last value of each field.

    Args:
        graph: the graph.
        topics: what is ticked first.
        name: of the panel's node.

    Raises:
        ViewError: there is no such topic.

    """

    tool: ClassVar[str] = "rqt_topic"
    heading: ClassVar[str] = "Topic Monitor"
    plugin: ClassVar[str] = "rqt_topic/TopicPlugin"

    def __init__(self, graph: Graph, *topics: str, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self._heard: dict[str, tuple[Heard, Subscriber]] = {}
        self._figures: dict[str, tuple[float, tuple[str, str]]] = {}
        for topic in topics:
            self.hear(topic)

    @property
    def topics(self) -> tuple[str, ...]:
        """What is heard."""
        return tuple(self._heard)

    def hear(self, topic: str, on: bool = True) -> None:
        """Listen to a topic, or no more. Raises ``ViewError`` for one that is not there."""
        self._require()
        if not on:
            if topic in self._heard:
                self._heard.pop(topic)[1].unregister()
            return
        known = known_topics(self.graph)
        if topic not in known:
            raise ViewError(
                f"there is no topic {topic!r:.80}; {nearest(topic, known) or '`rostopic list` lists all'}"
            )
        if topic not in self._heard:
            one = Heard(WINDOW)
            graph = self.graph
            subscriber = self.node.subscriber(
                topic,
                class_of(known[topic]),
                lambda message: one.hear(graph.now().to_nsec(), message),
                numpy=False,
            )
            self._heard[topic] = (one, subscriber)

    def parts(self) -> Sequence[Part]:
        """A row for each topic, and below those that are heard one for each field."""
        now = self.graph.now().to_sec()
        rows: list[Row] = []
        for topic, kind in known_topics(self.graph).items():
            tick = Control(f"hear/{topic}", f"hear {topic}", "check", topic in self._heard)
            one = self._heard[topic][0] if topic in self._heard else None
            figures = ("", "") if one is None else self._worked_out(topic, one, now)
            rows.append(
                Row((topic, tick, kind, *figures, "not heard yet" if one and one.last is None else ""))
            )
            if one is not None and one.last is not None:
                rows += [
                    Row((name, "", kind, "", "", value), depth)
                    for depth, name, kind, value in fields_of(one.last)
                ]
        return [
            Rows(("Topic", "Hear", "Type", "Bandwidth", "Hz", "Value"), tuple(rows), "Topics", "no topics")
        ]

    def _worked_out(self, topic: str, one: Heard, now: float) -> tuple[str, str]:
        before = self._figures.get(topic)
        if before is None or abs(now - before[0]) >= FIGURES_S:
            before = self._figures[topic] = (now, one.figures(now))
        return before[1]

    def settings(self) -> dict[str, Any]:
        """What is heard."""
        return {"topics": list(self._heard)}

    def restore(self, settings: dict[str, Any]) -> None:
        """Hear what was heard; what is not there is named at the end."""
        each_of(self.hear, settings.get("topics", []))

    def _operate(self, key: Sequence[str], value: Any) -> None:
        self.hear("/".join(key[1:]), value)
