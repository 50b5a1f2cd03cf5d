"""Calls in the future, ordered by time and, at one time, by the order in which they were asked for."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections import deque
    from collections.abc import Callable

SWEEP_FROM = 1_024
"""From this many entries on, cancelled ones are thrown out now and then."""


class Timer(list[Any]):
    """A call in the future that can be cancelled: ``[when_ns, sequence number, callback]``, ordered as lists are."""

    __slots__ = ()

    @property
    def when_ns(self) -> int:
        """When it is due."""
        return int(self[0])

    def cancel(self) -> None:
        """Do not call. Harmless when it was called already."""
        self[2] = None


class TimedEvents:
    """The timers that have not been called."""

    def __init__(self) -> None:
        self.heap: list[Timer] = []
        """What is to be called, ordered by time and then by number; it stays the same list."""
        self._sequence = 0
        self._sweep_at = SWEEP_FROM

    def __len__(self) -> int:
        return len(self.heap)

    def add(self, when_ns: int, callback: Callable[[], object]) -> Timer:
        """Note a call at ``when_ns``."""
        self._sequence += 1
        timer = Timer((when_ns, self._sequence, callback))
        heapq.heappush(self.heap, timer)
        if len(self.heap) >= self._sweep_at:
            self._sweep()
        return timer

    def _sweep(self) -> None:
        """Throw out cancelled calls: a wait with a long timeout that ends early leaves one."""
        self.heap[:] = [entry for entry in self.heap if entry[2] is not None]
        heapq.heapify(self.heap)
        self._sweep_at = max(SWEEP_FROM, 2 * len(self.heap))

    def take_due(self, now_ns: int, ready: deque[Callable[[], object]]) -> None:
        """Move the calls that are due into ``ready``."""
        heap = self.heap
        while heap and heap[0][0] <= now_ns:
            callback = heapq.heappop(heap)[2]
            if callback is not None:
                ready.append(callback)

    def next_ns(self) -> int | None:
        """Return the time of the next call, or None."""
        heap = self.heap
        while heap and heap[0][2] is None:
            heapq.heappop(heap)
        return int(heap[0][0]) if heap else None

    def clear(self) -> None:
        """Forget all."""
        self.heap.clear()
