"""`rqt_plot`: numbers in messages over time (http://wiki.ros.org/rqt_plot)."""

from __future__ import annotations

from bisect import bisect_left
from numbers import Real
from typing import TYPE_CHECKING, Any

from rosmini.ros.introspection.fields import FieldError, class_of, reader
from rosmini.viz.rqt.listening import find_topic, listen
from rosmini.viz.view import Picture, ViewError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rosmini.core.graph import Graph
    from rosmini.ros.bag import Bag

Samples = dict[str, tuple[list[float], list[float]]]
"""By the name of a field: times [s] and values."""

MANY = 40
"""So many points of a line have no marks of their own."""


def rqt_plot(source: Graph | Bag, *fields: str, duration: float = 5.0, title: str | None = None) -> Picture:
    """Plot fields of messages over time: a graph's, heard for ``duration`` seconds of its time, or those in a bag.

    Args:
        source: a graph, which runs meanwhile, or a bag.
        fields: names such as "/odom/pose/pose/position/x", as rostopic writes them, or "/odom/twist/twist/linear/x:y"
            for several fields beside one another; up to five.
        duration: how long to listen [s]; a bag is read from end to end.
        title: a caption under the picture, and the first words of its text form.

    Raises:
        ViewError: there is no such topic or field, a field is no number, or nothing was heard of one.

    """
    names = [name for field in fields for name in expanded(field)]
    if not names:
        raise ViewError("name a field, such as /odom/pose/pose/position/x")
    samples, begin = _heard(source, names, duration) if hasattr(source, "scheduler") else _read(source, names)
    silent = [name for name, (times, _) in samples.items() if not times]
    if silent:
        raise ViewError(f"no message came for {', '.join(silent)}; listen longer, or start its publisher")
    from rosmini.viz.plots import plot

    series = {name: ([time - begin for time in times], values) for name, (times, values) in samples.items()}
    most = max(len(times) for times, _ in series.values())
    return plot(series, x="time [s]", y="value", title=title or "rqt_plot", marks=most <= MANY)


def expanded(name: str) -> list[str]:
    """Return the fields that a name with colons stands for: "/p/x:y" is "/p/x" and "/p/y", as in rqt_plot.

    >>> expanded("/odom/pose/pose/position/x:y")
    ['/odom/pose/pose/position/x', '/odom/pose/pose/position/y']
    """
    parent, slash, last = name.rpartition("/")
    if "[" in last:  # a slice has colons, too
        return [name]
    return [f"{parent}{slash}{one}" for one in last.split(":")]


def _heard(graph: Any, names: list[str], duration: float) -> tuple[Samples, float]:
    found = {name: find_topic(graph, name) for name in names}
    series = {name: Series(name, topic.path) for name, topic in found.items()}

    def subscribe(node: Any) -> None:
        for one, topic in zip(series.values(), found.values(), strict=True):
            node.subscriber(topic.topic, class_of(topic.type), hearer(one), numpy=False)

    def hearer(one: Series) -> Callable[[Any], None]:
        return lambda message: one.take(graph.now().to_sec(), message)

    begin = listen(graph, "rqt_plot", duration, subscribe)
    return {name: one.points() for name, one in series.items()}, begin


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


class Series:
    """The values of one field. What is wrong with it is said at the end: a callback is no place for that."""

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
            self.problem = (
                f"it is a {type(value).__name__} and no number; go on with one of its fields or elements"
            )
            return
        self._times.append(time)
        self._values.append(float(value))

    def forget(self, before: float) -> None:
        """Forget what came before a time [s]."""
        count = bisect_left(self._times, before)
        del self._times[:count], self._values[:count]

    def points(self) -> tuple[list[float], list[float]]:
        """Return times and values. Raises ``ViewError`` if the field was none, or no number."""
        if self.problem:
            raise ViewError(f"{self._name}: {self.problem}")
        return self._times, self._values
