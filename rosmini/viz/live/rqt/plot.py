"""`rqt_plot` that goes on: numbers in messages over time (http://wiki.ros.org/rqt_plot)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from rosmini.ros.introspection.fields import class_of
from rosmini.viz.plots import COLOURS, plot
from rosmini.viz.rqt.listening import find_topic
from rosmini.viz.rqt.plot import MANY, Series, expanded
from rosmini.viz.view import ViewError

from .panel import Panel, bar, each_of
from .parts import Control, Drawing, Words

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.core.graph import Graph
    from rosmini.core.graph.subscriber import Subscriber

    from .parts import Part

REDRAW_S = 1.0
"""How often the lines are drawn again [s]."""


class Plot(Panel):
    """Plot any numbers in messages, from now on.

    Args:
        graph: the graph.
        fields: names such as ``/odom/twist/twist/linear/x``, ``/odom/pose/pose/position/x:y``, ``/scan/ranges[0]``.
        seconds: how much of the past is shown [s].
        name: of the panel's node.

    Raises:
        ViewError: there is no such topic or field, or there are more than can be told apart.

    """

    tool: ClassVar[str] = "rqt_plot"
    heading: ClassVar[str] = "Plot"
    plugin: ClassVar[str] = "rqt_plot/Plot"

    def __init__(self, graph: Graph, *fields: str, seconds: float = 20.0, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.seconds = seconds
        self._lines: dict[str, tuple[Series, Subscriber]] = {}
        self._field = "/odom/twist/twist/linear/x"
        self._paused = False
        self._drawn: tuple[float, Drawing] | None = None
        for field in fields:
            self.add(field)

    @property
    def fields(self) -> tuple[str, ...]:
        """What is plotted."""
        return tuple(self._lines)

    def add(self, field: str) -> None:
        """Plot a field, or several: ``/p/x:y``. Raises ``ViewError``."""
        self._require()
        new = {name: find_topic(self.graph, name) for name in expanded(field)}
        if len({*self._lines, *new}) > len(COLOURS):
            raise ViewError(f"{len(COLOURS)} lines can be told apart, not more: remove one first")
        for name, found in new.items():
            if name not in self._lines:
                series = Series(name, found.path)
                subscriber = self.node.subscriber(
                    found.topic, class_of(found.type), self._hearer(series), numpy=False
                )
                self._lines[name] = (series, subscriber)
        self._drawn = None

    def remove(self, field: str) -> None:
        """Plot a field no more. Raises ``ViewError`` if it was not plotted."""
        if field not in self._lines:
            raise ViewError(f"{field!r:.80} is not plotted; there are {', '.join(self._lines) or 'none'}")
        self._lines.pop(field)[1].unregister()
        self._drawn = None

    def clear(self) -> None:
        """Forget what came so far."""
        for series, _ in self._lines.values():
            series.forget(float("inf"))
        self._drawn = None

    def _hearer(self, series: Series) -> Callable[[Any], None]:
        def hear(message: Any) -> None:
            now = self.graph.now().to_sec()
            series.take(now, message)
            if not self._paused:
                series.forget(now - self.seconds)

        return hear

    def parts(self) -> Sequence[Part]:
        """What is plotted, and the lines."""
        now = self.graph.now().to_sec()
        fresh = self._drawn is not None and (self._paused or abs(now - self._drawn[0]) < REDRAW_S)
        if self._drawn is None or not fresh:
            self._drawn = (now, self._drawing(now))
        remove = [Control(f"remove/{name}", f"Remove {name}", "button") for name in self._lines]
        return [
            bar(
                Control("field", "Field", "text", self._field),
                Control("add", "Add", "button"),
                Control("seconds", "Seconds", "number", self.seconds, minimum=0.1, maximum=3600.0),
                Control("pause", "Pause", "check", self._paused),
                Control("clear", "Clear", "button"),
            ),
            *([bar(*remove)] if remove else []),
            self._drawn[1],
            *(
                Words(f"{name}: {series.problem}", is_bad=True)
                for name, (series, _) in self._lines.items()
                if series.problem
            ),
        ]

    def _drawing(self, now: float) -> Drawing:
        points = {name: series.points() for name, (series, _) in self._lines.items() if not series.problem}
        heard = {name: found for name, found in points.items() if found[0]}
        if not heard:
            return Drawing("<p>no number has come yet</p>", "no number has come yet")
        lines = {name: ([time - now for time in times], values) for name, (times, values) in heard.items()}
        most = max(len(times) for times, _ in lines.values())
        drawn = plot(lines, x="time from now [s]", y="value", title=self.tool, marks=most <= MANY)
        return Drawing(drawn.svg or "", drawn.text)

    def settings(self) -> dict[str, Any]:
        """What is plotted, by the real one's name."""
        return {"topics": list(self._lines)}

    def restore(self, settings: dict[str, Any]) -> None:
        """Plot what was plotted; what is not there is named at the end."""
        topics = settings.get("topics", [])
        each_of(self.add, [topics] if isinstance(topics, str) else topics)

    def _operate(self, key: Sequence[str], value: Any) -> None:
        match key[0]:
            case "field":
                self._field = value
            case "add":
                self.add(self._field)
            case "remove":
                self.remove("/".join(key[1:]))
            case "seconds":
                self.seconds = value
            case "pause":
                self._paused = value
            case _:
                self.clear()
