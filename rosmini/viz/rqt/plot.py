"""`rqt_plot`: numbers in messages over time (http://wiki.ros.org/rqt_plot)."""

from __future__ import annotations

import re
from bisect import bisect_left
from numbers import Real
from typing import TYPE_CHECKING, Any

from rosmini.core.verbs import Call, global_name
from rosmini.ros.introspection.fields import FieldError, class_of, reader
from rosmini.ros.introspection.topics import Found, look_up, what_next
from rosmini.viz.plots import COLOURS, plot
from rosmini.viz.view import Picture, View, ViewError

from .panel import Panel, bar, each_of, pass_time
from .parts import Control, Drawing, Part, Words, drawn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from optparse import Values

    from rosmini.core.graph import Graph
    from rosmini.core.graph.subscription import Subscriber
    from rosmini.ros.bag import Bag

Samples = dict[str, tuple[list[float], list[float]]]
"""Times [s] and values, by the name of the field."""

MANY = 40
"""Lines with more points are drawn without marks."""


def rqt_plot(source: Graph | Bag, *fields: str, duration: float = 5.0, title: str | None = None) -> Picture:
    """Plot fields of messages over time: messages of a graph in ``duration`` seconds, or the messages in a bag.

    Args:
        source: a graph, which runs meanwhile, or a bag.
        fields: names such as "/odom/pose/pose/position/x", as rostopic writes them, or "/odom/twist/twist/linear/x:y"
            for several fields of a message; up to five.
        duration: how long to listen [s]; a bag is read from end to end.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: there is no such topic or field, a field is not a number, or no message came for one.

    """
    names = [name for field in fields for name in expanded(field)]
    if not names:
        raise ViewError("name a field, such as /odom/pose/pose/position/x")
    samples, begin = _heard(source, names, duration) if hasattr(source, "scheduler") else _read(source, names)
    silent = [name for name, (times, _) in samples.items() if not times]
    if silent:
        raise ViewError(f"no message came for {', '.join(silent)}; listen longer, or start its publisher")
    picture = _plotted(samples, begin, x="time [s]", title=title or "rqt_plot")
    picture.caption = title
    return picture


def _plotted(samples: Samples, zero: float, *, x: str, title: str) -> Picture:
    """Plot samples over the time since ``zero``."""
    lines = {name: ([time - zero for time in times], values) for name, (times, values) in samples.items()}
    most = max(len(times) for times, _ in lines.values())
    return plot(lines, x=x, y="value", title=title, marks=most <= MANY)


def expanded(name: str) -> list[str]:
    """Return the fields in a name with colons: "/p/x:y" is "/p/x" and "/p/y", as in rqt_plot.

    >>> expanded("/odom/pose/pose/position/x:y")
    ['/odom/pose/pose/position/x', '/odom/pose/pose/position/y']
    """
    parent, slash, last = name.rpartition("/")
    if "[" in last:  # a slice contains colons, too
        return [name]
    return [f"{parent}{slash}{one}" for one in last.split(":")]


def _heard(graph: Any, names: list[str], duration: float) -> tuple[Samples, float]:
    begin = graph.now().to_sec()
    with Plot.alone(graph, *names, seconds=float("inf")) as panel:
        pass_time(graph, duration)
        return panel.samples(), begin


def _read(bag: Any, names: Iterable[str]) -> tuple[Samples, float]:
    topics = sorted({connection.topic for connection in bag.index.connections.values()}, reverse=True)
    samples: Samples = {}
    for name in names:
        topic = next((each for each in topics if f"{name}/".startswith(f"{each}/")), None)
        if topic is None:
            raise ViewError(f"the bag has no topic of {name}; it has {', '.join(topics)}")
        series = Series(name, name[len(topic) :])
        for _, message, time in bag.read_messages(topics=[topic]):
            series.take(time.to_sec(), message)
        samples[name] = series.points()
    return samples, min((times[0] for times, _ in samples.values() if times), default=0.0)


def find_topic(graph: Graph, name: str) -> Found:
    """Return the topic of a name that may continue with fields.

    Raises:
        ViewError: there is no such topic or field, or its type is unknown here; the message names the nearest.

    """
    full = name if name.startswith("/") else f"/{name}"
    found = look_up(graph, full)
    if found is None:
        raise ViewError(f"there is nothing to hear at {full}; {what_next(graph, full)}")
    if class_of(found.type) is None:
        raise ViewError(f"messages on {found.topic} are {found.type}, which no package here defines")
    return found


class Series:
    """The values of one field. An error is raised by `points`, since a callback must not raise it."""

    def __init__(self, name: str, path: str) -> None:
        self._name = name
        self._times: list[float] = []
        self._values: list[float] = []
        self.problem = ""
        try:
            self._read = reader(path)
        except FieldError as error:
            raise ViewError(f"{name}: {error}") from error

    def take(self, time: float, message: Any) -> None:
        """Add the field of a message that came at a time [s]."""
        if self.problem:
            return
        try:
            value = self._read(message)
        except FieldError as error:
            self.problem = str(error)
            return
        value = value.to_sec() if hasattr(value, "to_sec") else value
        if not isinstance(value, Real):
            self.problem = f"it is a {type(value).__name__} and no number; go on with one of its fields or elements"
            return
        self._times.append(time)
        self._values.append(float(value))

    def forget(self, before: float) -> None:
        """Remove the values from before a time [s]."""
        count = bisect_left(self._times, before)
        del self._times[:count], self._values[:count]

    def points(self) -> tuple[list[float], list[float]]:
        """Return times and values. Raises ``ViewError`` if there is no such field, or it is not a number."""
        if self.problem:
            raise ViewError(f"{self._name}: {self.problem}")
        return self._times, self._values


class Plot(Panel):
    """Numbers in messages from now on, as lines over time.

    Args:
        graph: the graph.
        fields: names such as ``/odom/twist/twist/linear/x``, ``/odom/pose/pose/position/x:y``, ``/scan/ranges[0]``.
        seconds: length of the time shown [s].
        name: name of the panel's node.

    Raises:
        ViewError: there is no such topic or field, or there are more than five lines.

    """

    tool, heading, plugin = "rqt_plot", "Plot", "rqt_plot/Plot"
    group, summary = "Visualization", "numbers in messages over time; x:y stands for two fields of a message"
    usage, takes, example, listen_s = "FIELD...", "topic", "/odom/pose/pose/position/x:y", 5.0

    def __init__(self, graph: Graph, *fields: str, seconds: float = 20.0, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.seconds = seconds
        self._lines: dict[str, tuple[Series, Subscriber]] = {}
        self._field = "/odom/twist/twist/linear/x"
        self._paused = False
        for field in fields:
            self.add(field)

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the fields; the topic of each is a global name."""
        split = [re.fullmatch(r"([^\[]*)(.*)", word) for word in given.words]
        return [f"{global_name(each[1])}{each[2]}" for each in split if each], {}

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Listen for some time, and plot the fields."""
        fields, _ = cls.arguments(given)
        return rqt_plot(call.graph, *fields, duration=given.duration, title=given.title)

    @property
    def fields(self) -> tuple[str, ...]:
        """The plotted fields."""
        return tuple(self._lines)

    def samples(self) -> Samples:
        """Return times and values of each field. Raises ``ViewError`` for a field that is not a number."""
        return {name: series.points() for name, (series, _) in self._lines.items()}

    def add(self, field: str) -> None:
        """Plot a field, or several: ``/p/x:y``. Raises ``ViewError``."""
        self._require()
        new = {name: find_topic(self.graph, name) for name in expanded(field)}
        if len({*self._lines, *new}) > len(COLOURS):
            raise ViewError(f"{len(COLOURS)} lines are the maximum: remove one first")
        for name, found in new.items():
            if name not in self._lines:
                series = Series(name, found.path)
                subscriber = self.node.subscriber(found.topic, class_of(found.type), self._hearer(series), numpy=False)
                self._lines[name] = (series, subscriber)
        self._drawn = None

    def remove(self, field: str) -> None:
        """Stop plotting a field. Raises ``ViewError`` if it is not plotted."""
        if field not in self._lines:
            raise ViewError(f"{field!r:.80} is not plotted; there are {', '.join(self._lines) or 'none'}")
        self._lines.pop(field)[1].unregister()
        self._drawn = None

    def clear(self) -> None:
        """Remove all values."""
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
        """The controls, and the lines."""
        lines = self._drawn[1] if self._paused and self._drawn else self._redrawn(self._drawing)
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
            lines,
            *(
                Words(f"{name}: {series.problem}", is_bad=True)
                for name, (series, _) in self._lines.items()
                if series.problem
            ),
        ]

    def _drawing(self) -> Drawing:
        now = self.graph.now().to_sec()
        good = {name: series for name, (series, _) in self._lines.items() if not series.problem}
        heard = {name: series.points() for name, series in good.items() if series.points()[0]}
        if not heard:
            return Drawing("<p>no value received yet</p>", "no value received yet")
        return drawn(_plotted(heard, now, x="time from now [s]", title=self.tool))

    def settings(self) -> dict[str, Any]:
        """Return the plotted fields under rqt_plot's key."""
        return {"topics": list(self._lines)}

    def restore(self, settings: dict[str, Any]) -> None:
        """Plot the fields of a perspective; one error names all that fail."""
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
