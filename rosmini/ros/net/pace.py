"""Simulated time that goes no faster than the clock on the wall: others live on it, and cannot keep up otherwise."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

from .io_thread import later

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler

    from .io_thread import IoThread

LAG_NS = 100_000_000
"""How far time runs after the wall to make up for a delay; after a longer one it goes on from where it stood."""


class Pace:
    """Lets a graph's time stand still, while what comes from the network is taken, until the wall has caught up."""

    def __init__(self, scheduler: Scheduler, io: IoThread) -> None:
        self._scheduler = scheduler
        self._io = io
        self._lock = threading.Lock()
        self._holds = False
        self._begin()

    def _begin(self) -> None:
        self._graph_ns, self._wall_ns = self._scheduler.now_ns(), time.perf_counter_ns()

    def keep(self) -> None:
        """Hold the time back if it is ahead. In the hub's thread, again and again."""
        passed = time.perf_counter_ns() - self._wall_ns
        ahead = self._scheduler.now_ns() - self._graph_ns - passed
        if ahead < -LAG_NS:
            self._begin()
        elif ahead > 0 and not self._holds:
            self._holds = True
            self._scheduler.hold()
            later(self._io.loop, ahead / 1e9, self.end)

    def end(self) -> None:
        """Let the time go on. From any thread; harmless when repeated."""
        with self._lock:
            held, self._holds = self._holds, False
        if held:
            self._scheduler.release()
