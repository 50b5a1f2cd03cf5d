"""Keeps simulated time from running faster than real time, so that other processes can keep up."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

from .io_thread import later

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph
    from rosmini.core.graph.event_queue import Timer

    from .io_thread import IoThread

LAG_NS = 100_000_000
"""Maximum delay that is made up for by running faster [ns]; after a longer one, time continues from there."""

PERIOD_NS = 10_000_000
"""Interval at which the two times are compared [ns]."""


class Pace:
    """Stops a graph's time, while data from the network is processed, until real time has caught up.

    A live graph keeps its own pace.
    """

    def __init__(self, graph: Graph, io: IoThread) -> None:
        self._graph = graph
        self._scheduler = graph.scheduler
        self._io = io
        self._lock = threading.Lock()
        self._holds = False
        self._conditions: list[Callable[[], bool]] = []
        self._timer: Timer | None = None

    def keep(self, condition: Callable[[], bool]) -> None:
        """Limit the graph's time to real time while ``condition()`` is true. Only from the scheduler's thread."""
        if not self._conditions:
            self._begin()
        self._conditions.append(condition)
        if self._timer is None:
            self._next()

    def _begin(self) -> None:
        self._graph_ns, self._wall_ns = self._scheduler.now_ns(), time.perf_counter_ns()

    def _next(self) -> None:
        self._timer = self._scheduler.call_at(self._scheduler.now_ns() + PERIOD_NS, self._compare)

    def _compare(self) -> None:
        self._conditions = [condition for condition in self._conditions if condition()]
        if not self._conditions:
            self._timer = None
            return
        self._next()
        if not self._graph.is_live:
            self._wait()

    def _wait(self) -> None:
        """Stop the time if it is ahead."""
        passed = time.perf_counter_ns() - self._wall_ns
        ahead = self._scheduler.now_ns() - self._graph_ns - passed
        if ahead < -LAG_NS:
            self._begin()
        elif ahead > 0 and not self._holds:
            self._holds = True
            self._scheduler.hold()
            later(self._io.loop, ahead / 1e9, self._release)

    def end(self) -> None:
        """Stop comparing, and release the time. Only from the scheduler's thread."""
        self._conditions.clear()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._release()

    def _release(self) -> None:
        """Release the time; may be called repeatedly and from any thread."""
        with self._lock:
            held, self._holds = self._holds, False
        if held:
            self._scheduler.release()
