"""Measurements of ``rostopic`` for scripts: callbacks for ``rospy.Subscriber``, and their results."""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from rosmini.core.graph import running_graph
from rosmini.ros.introspection.rates import Arrivals, Delays, Sizes, Statistics, delay_text, rate_table, rate_text
from rosmini.ros.rospy.rostime import get_rostime

Numbers = tuple[float, float, float, float, int]


class ROSTopicHz:
    """Measures the rate of messages: ``callback_hz`` is the callback, ``get_hz`` returns the rate."""

    def __init__(
        self, window_size: int, filter_expr: Callable[[Any], object] | None = None, use_wtime: bool = False
    ) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self.filter_expr = filter_expr
        self.use_wtime = use_wtime
        self._arrivals: defaultdict[str | None, Arrivals] = defaultdict(partial(Arrivals, window_size))

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Count a message of a topic, if it passes the filter."""
        if self.filter_expr is not None and not self.filter_expr(m):
            return
        now = running_graph().scheduler.now_ns() if self.use_wtime else get_rostime().to_nsec()
        with self.lock:
            self._arrivals[topic].heard(now)

    def get_times(self, topic: str | None = None) -> list[float]:
        """Return the times between the last messages [s]."""
        return [value / 1e9 for value in self._arrivals[topic].values]

    def _statistics(self, topic: str | None) -> Statistics | None:
        with self.lock:
            return self._arrivals[topic].statistics()

    def get_hz(self, topic: str | None = None) -> Numbers | None:
        """Return (rate [Hz], shortest, longest time between two messages, standard deviation [s], number of messages).

        Return None before the second message, and if none has come since the last call.
        """
        found = self._statistics(topic)
        return None if found is None else (found.rate, *found[1:])

    def print_hz(self, topics: Sequence[str | None] = (None,)) -> None:
        """Print the rates of topics."""
        found = {str(topic): one for topic in topics if (one := self._statistics(topic)) is not None}
        if not found:
            print("no new messages")
        elif len(topics) == 1:
            print(rate_text(next(iter(found.values()))))
        else:
            print(rate_table(found))


class ROSTopicDelay:
    """Measures the age of messages on arrival, from their headers."""

    def __init__(self, window_size: int) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size
        self._delays = Delays(window_size)

    def callback_delay(self, msg: Any) -> None:
        """Count a message."""
        from rosmini.ros.rospy import logerr

        if not msg._has_header:
            logerr("msg does not have header")
            return
        with self.lock:
            self._delays.heard(get_rostime().to_nsec(), msg.header.stamp.to_nsec())

    def get_delay(self) -> Numbers | None:
        """Return (mean, smallest, largest age, standard deviation [s], number of messages); None without new ones."""
        with self.lock:
            found = self._delays.statistics()
        return None if found is None else (found.mean, *found[1:])

    def print_delay(self) -> None:
        """Print the delay."""
        if self._delays.values:
            with self.lock:
                found = self._delays.statistics()
            print("no new messages" if found is None else delay_text(found))


class ROSTopicBandwidth:
    """Measures the bandwidth; ``callback`` is for a subscriber of ``rospy.AnyMsg``."""

    def __init__(self, window_size: int = 100) -> None:
        self.lock = threading.Lock()
        self.window_size = window_size or 100
        self._sizes = Sizes(self.window_size)

    def callback(self, data: Any) -> None:
        """Count a message."""
        with self.lock:
            self._sizes.heard(running_graph().scheduler.now_ns() / 1e9, len(data._buff))  # noqa: SLF001 - rospy's name

    def print_bw(self) -> None:
        """Print the bandwidth."""
        with self.lock:
            found = self._sizes.weight(running_graph().scheduler.now_ns() / 1e9)
        if found is not None:
            print(found)
