"""Statistics of a subscriber's connections, as in rospy (http://wiki.ros.org/Topics#Topic_statistics).

A node that subscribes while ``/enable_statistics`` is true publishes on ``/statistics`` the traffic, the period and the
age of the messages of each publisher. The length of a window follows the number of messages in it, within the bounds
that the parameters ``/statistics_window_*`` set.
"""

from __future__ import annotations

from math import isqrt
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import MasterUnreachable, ParameterError
from rosmini.core.graph.connection import Observer
from rosmini.core.time import Duration, Time
from rosmini.msgs import message_class

if TYPE_CHECKING:
    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.node import Node

TOPIC = "/statistics"
PARAMETER = "/enable_statistics"
WITHOUT = frozenset([TOPIC, "/clock"])
"""Topics without statistics: the clock starts first, and statistics of statistics would never end."""

LENGTH_SIZE = 4
"""Number of bytes that precede each message on a wire and contain its length."""

SECOND = 1_000_000_000


def are_wanted(node: Node, topic: str) -> bool:
    """Return whether ``/enable_statistics`` is true and the topic can have statistics.

    Returns False if the Master does not respond, as in rospy. A Master in this process is called without recording the
    call, because the parameter is read for every subscriber.
    """
    if topic in WITHOUT:
        return False
    port = node.graph.master
    try:
        if port.is_local:
            code, _, value = port.getParam(node.name, PARAMETER)
        else:
            code, _, value = node.master.call("getParam", PARAMETER)
    except MasterUnreachable:
        return False
    return code == 1 and bool(value)


class TopicStatistics:
    """The statistics of one node's connections to a topic: one window for each publisher."""

    def __init__(self, node: Node, topic: str) -> None:
        self._node = node
        self._topic = topic
        self._windows: dict[str, _Window] = {}
        self.elements = self._bounds("elements", 10, 100)
        """Numbers of messages in a window: below the first it gets longer, above the second shorter."""
        self.seconds = self._bounds("size", 4, 64)
        """Bounds of a window's length [s]."""

    def _bounds(self, what: str, *defaults: float) -> tuple[float, float]:
        least, most = (
            self._parameter(f"/statistics_window_{end}_{what}", default)
            for end, default in zip(("min", "max"), defaults, strict=True)
        )
        return least, most

    def _parameter(self, name: str, default: float) -> float:
        try:
            value: float = self._node.get_param(name, default, expect=float)
        except MasterUnreachable:
            return default
        except ParameterError as error:
            self._node.logerr(f"{error} Statistics of {self._topic} use the default, {default}.")
            return default
        return value

    def observer(self, connection: Connection) -> Observer:
        """Return an observer that counts the messages of a connection."""
        return _Counter(self, connection)

    def window(self, publisher: str) -> _Window:
        """Return the window of a publisher's messages."""
        window = self._windows.get(publisher)
        if window is None:
            window = self._windows[publisher] = _Window(self, self._node, self._topic, publisher)
        return window

    def close(self) -> None:
        """Stop publishing statistics."""
        for window in self._windows.values():
            window.close()
        self._windows.clear()


class _Counter(Observer):
    """Counts the messages of one connection before the callbacks get them."""

    def __init__(self, statistics: TopicStatistics, connection: Connection) -> None:
        self._statistics = statistics
        self._connection = connection

    def before(self, frozen: Any) -> None:
        self._statistics.window(self._connection.peer).add(frozen)


class _Window:
    """The messages of one connection since its statistics were last published; all times are in nanoseconds."""

    def __init__(self, statistics: TopicStatistics, node: Node, topic: str, publisher: str) -> None:
        self._statistics = statistics
        self._node = node
        self._names = {"topic": topic, "node_pub": publisher, "node_sub": node.name}
        self._class = message_class("rosgraph_msgs/TopicStatistics")
        self._publisher = node.publisher(TOPIC, self._class, queue_size=10)
        self._length = 1.0
        """The length of the window [s]."""
        self._published = 0
        self._last_seq = 0
        self._start = node.clock.now_ns()
        self._clear()

    def _clear(self) -> None:
        self._arrivals: list[int] = []
        self._ages: list[int] = []
        self._bytes = 0
        self._dropped = 0

    def add(self, message: Any) -> None:
        """Count a message, and publish the statistics if the window is over.

        A gap in the sequence numbers counts as one dropped message, however long it is, as in rospy.
        """
        now = self._node.clock.now_ns()
        self._arrivals.append(now)
        self._bytes += LENGTH_SIZE + len(type(message)._encode(message))
        if message._has_header:
            header = message.header
            self._ages.append(now - header.stamp.to_nsec())
            self._dropped += header.seq != self._last_seq + 1
            self._last_seq = header.seq
        if self._published + int(self._length * SECOND) < now:
            self._published = now
            self._publish(now)

    def _publish(self, now: int) -> None:
        count = len(self._arrivals)
        periods = [later - earlier for earlier, later in zip(self._arrivals, self._arrivals[1:], strict=False)]
        message = self._class(
            **self._names,
            window_start=Time(0, self._start),
            window_stop=Time(0, now),
            delivered_msgs=count,
            dropped_msgs=self._dropped,
            traffic=self._bytes,
            **_spread("period", periods),
            **_spread("stamp_age", self._ages),
        )
        self._clear()
        self._start = now
        (fewest, most), (shortest, longest) = self._statistics.elements, self._statistics.seconds
        if count > most and self._length / 2 >= shortest:
            self._length /= 2
        elif count < fewest and self._length * 2 <= longest:
            self._length *= 2
        if self._publisher.num_connections():
            self._publisher.publish(message)

    def close(self) -> None:
        self._publisher.unregister()


def _spread(name: str, values: list[int]) -> dict[str, Duration]:
    """Return the fields for the mean, the standard deviation and the maximum of durations [ns]."""
    mean = sum(values) // len(values) if values else 0
    deviation = isqrt(sum((value - mean) ** 2 for value in values) // len(values)) if values else 0
    fields = {"mean": mean, "stddev": deviation, "max": max(values, default=0)}
    return {f"{name}_{field}": Duration(0, value) for field, value in fields.items()}
