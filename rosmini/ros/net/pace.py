"""Keeps simulated time from running faster than real time, so that other processes can keep up."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

from .io_thread import later

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler

    from .io_thread import IoThread

LAG_NS = 100_000_000
"""Maximum delay that is made up for by running faster [ns]; after a longer one, time continues from there."""


class Pace:
    """Stops a graph's time, while data from the network is processed, until real time has caught up."""

    def __init__(self, scheduler: Scheduler, io: IoThread) -> None:
        self._scheduler = scheduler
        self._io = io
        self._lock = threading.Lock()
        self._holds = False
        self._begin()

    def _begin(self) -> None:
        self._graph_ns, self._wall_ns = self._scheduler.now_ns(), time.perf_counter_ns()

    def keep(self) -> None:
        """Stop the time if it is ahead; called repeatedly in the hub's thread."""
        passed = time.perf_counter_ns() - self._wall_ns
        ahead = self._scheduler.now_ns() - self._graph_ns - passed
        if ahead < -LAG_NS:
            self._begin()
        elif ahead > 0 and not self._holds:
            self._holds = True
            self._scheduler.hold()
            later(self._io.loop, ahead / 1e9, self.end)

    def end(self) -> None:
        """Release the time; may be called repeatedly and from any thread."""
        with self._lock:
            held, self._holds = self._holds, False
        if held:
            self._scheduler.release()
