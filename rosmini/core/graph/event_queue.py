"""The part of the scheduler without lanes: the time, and events that are due now, due later, or from another thread."""

from __future__ import annotations

import heapq
import threading
import time
from _thread import get_ident
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from math import inf
from numbers import Real
from typing import Any, Generic, Protocol, TypeVar

from rosmini.core.errors import RosminiError, shown

from .stacks import held_lock, yielding
from .threads import MAIN_THREAD

SWEEP_FROM = 1_024
"""Number of entries above which cancelled ones are removed from time to time."""


class Timer(list[Any]):
    """A future call that can be cancelled: ``[when_ns, sequence number, callback]``, ordered as lists are."""

    __slots__ = ()

    @property
    def when_ns(self) -> int:
        """The graph time at which the call is due [ns]."""
        return int(self[0])

    def cancel(self) -> None:
        """Cancel the call. Harmless if it has already been made."""
        self[2] = None


class TimedEvents:
    """The timers whose calls have not been made yet, ordered by time."""

    def __init__(self) -> None:
        self.heap: list[Timer] = []
        """The scheduled calls, ordered by time and then by number; always the same list."""
        self._sequence = 0
        self._sweep_at = SWEEP_FROM

    def __len__(self) -> int:
        return len(self.heap)

    def add(self, when_ns: int, callback: Callable[[], object]) -> Timer:
        """Schedule a call at graph time ``when_ns``; return its timer."""
        self._sequence += 1
        timer = Timer((when_ns, self._sequence, callback))
        heapq.heappush(self.heap, timer)
        if len(self.heap) >= self._sweep_at:
            self._sweep()
        return timer

    def _sweep(self) -> None:
        """Remove cancelled calls: a wait with a long timeout that ends early leaves one."""
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
        """Return the time of the next call [ns], or None if there is none."""
        heap = self.heap
        while heap and heap[0][2] is None:
            heapq.heappop(heap)
        return int(heap[0][0]) if heap else None

    def clear(self) -> None:
        """Remove all calls."""
        self.heap.clear()


T = TypeVar("T")


class Sleeper(Protocol):
    """A place where the reader of an inbox sleeps, so that other events can wake it too."""

    is_asleep: bool

    def sleep(self, timeout: float, nothing_came: Callable[[], bool]) -> None:
        """Sleep for at most `timeout` seconds, unless something arrived before `is_asleep` became true."""

    def wake(self) -> None:
        """Wake the reader. Safe in any thread and in a signal handler."""


class Inbox(Generic[T]):
    """A queue with any number of writing threads and one reader. A signal handler may write during another `put`.

    Not a ``queue.SimpleQueue``: before Python 3.12 its ``get`` may wait for ever if the timeout expires before the
    wait begins, as happens on a busy machine.
    """

    def __init__(self) -> None:
        self._items: deque[T] = deque()
        self._bell = held_lock()  # free if something has arrived since the last wait
        self.sleeper: Sleeper | None = None

    def put(self, item: T) -> None:
        """Add an item and wake the reader."""
        self._items.append(item)
        sleeper = self.sleeper
        if sleeper is not None and sleeper.is_asleep:
            sleeper.wake()
            return
        with suppress(RuntimeError):  # it was already free
            self._bell.release()

    @yielding
    def empty(self) -> bool:
        """Return True if the inbox is empty."""
        return not self._items

    def get(self) -> T:
        """Return the oldest item. Raises ``IndexError`` if the inbox is empty."""
        return self._items.popleft()

    def wait(self, timeout: float) -> None:
        """Wait for at most `timeout` seconds until there is an item; may return early without one."""
        sleeper = self.sleeper
        if sleeper is not None:
            sleeper.sleep(timeout, self.empty)
        elif not self._items:
            self._bell.acquire(timeout=timeout)


SIMULATED_START_NS = 1_000 * 10**9
"""Start of simulated time: not zero, because ``Time(0)`` means "the latest"."""

TICK_QUANTUM_NS = 1_000_000
"""Step of simulated time in a polling loop, and at an instant whose events never end."""

ROUNDS_PER_INSTANT = 10_000
"""Maximum number of rounds of events at one instant; more than this means that nodes trigger each other endlessly."""

ROUNDS_PER_QUANTUM = 20
"""Number of further rounds for which time advances by one quantum: 0.1 ms for a message and its callback."""


def span_ns(seconds: float, what: str) -> int:
    """Return a span of graph time in nanoseconds.

    Raises ``RosminiError``, which names ``what``, unless the number is finite and at least zero.
    """
    if isinstance(seconds, Real) and not isinstance(seconds, bool) and 0 <= seconds < inf:
        return int(seconds * 1e9)
    msg = f"{what} is a number of seconds, zero or more, not {shown(seconds)}; leave it out for no limit"
    raise RosminiError(msg)


class EventQueue:
    """Events in the order of their times; see :class:`~rosmini.core.graph.scheduler.Scheduler`, which runs them."""

    def __init__(self, *, simulated: bool = True, rate: float = 1.0) -> None:
        if not rate > 0:
            msg = f"the rate of a clock must be positive, not {rate!r}"
            raise RosminiError(msg)
        self.simulated = simulated
        self.rate = rate
        self.thread = get_ident()
        self.ready: deque[Callable[[], object]] = deque()
        self._now = SIMULATED_START_NS
        self._wall_start = time.time_ns()
        self._mono_start = time.perf_counter_ns()  # on Windows monotonic() steps by 15.6 ms before Python 3.13
        self._timed = TimedEvents()
        self._last: list[Callable[[], object]] = []
        self._rounds = 0
        self._inbox: Inbox[Callable[[], object] | None] = Inbox()
        self._holds = 0
        self._remote_waits = 0
        self._hold_lock = threading.Lock()

    def now_ns(self) -> int:
        """Return the graph time in nanoseconds."""
        if self.simulated:
            return self._now
        return self._wall_start + int((time.perf_counter_ns() - self._mono_start) * self.rate)

    def call_at(self, when_ns: int, callback: Callable[[], object]) -> Timer:
        """Call ``callback`` at graph time ``when_ns`` (at once if that is past). Only from the scheduler's thread."""
        return self._timed.add(when_ns, callback)

    def call_soon(self, callback: Callable[[], object]) -> None:
        """Call ``callback`` after all events that are due now. It must not block; use a lane for code that may."""
        if get_ident() == self.thread:
            self.ready.append(callback)
        else:
            self._inbox.put(callback)

    def call_last(self, callback: Callable[[], object]) -> None:
        """Call ``callback`` as soon as no other event is due. Only from the scheduler's thread."""
        self._last.append(callback)

    def call_soon_threadsafe(self, callback: Callable[[], object]) -> None:
        """Like :meth:`call_soon`, but always through the inbox, which other threads must use."""
        self._inbox.put(callback)

    def sleep_in(self, sleeper: Sleeper | None) -> None:
        """Let the scheduler sleep in ``sleeper`` when it has nothing to do; None means in the inbox."""
        self._inbox.sleeper = sleeper

    def is_scheduler_thread(self) -> bool:
        """Return True if the caller is in the thread that runs the queue."""
        return get_ident() == self.thread

    def is_in_main_thread(self) -> bool:
        """Return True if the queue runs in the main thread."""
        return self.thread == MAIN_THREAD

    def hold(self) -> None:
        """Stop simulated time until :meth:`release`, because work is running outside the queue."""
        with self._hold_lock:
            self._holds += 1

    def release(self) -> None:
        """Undo one :meth:`hold`, from any thread, after its result has been put into the inbox."""

        def let_go() -> None:
            with self._hold_lock:
                self._holds -= 1

        self._inbox.put(let_go)

    def count_remote(self, change: int) -> None:
        """Change the number of waits for other processes, which may take any time. Safe in any thread."""
        with self._hold_lock:
            self._remote_waits += change

    def is_idle(self) -> bool:
        """Return True if no event is due now."""
        due = self._timed.next_ns()
        return not self.ready and not self._last and self._inbox.empty() and (due is None or due > self.now_ns())

    def pending(self) -> int:
        """Return the number of events that are due now or later."""
        return len(self.ready) + len(self._timed)

    # -- for the scheduler's loop --------------------------------------------------------------------------------

    def _empty_inbox(self) -> None:
        """Move the calls posted by other threads into ``ready``."""
        inbox = self._inbox
        while not inbox.empty():
            item = inbox.get()
            if item is not None:
                self.ready.append(item)

    def _take_due(self) -> None:
        self._timed.take_due(self.now_ns(), self.ready)

    def count_rounds(self, rounds: int) -> None:
        """Count a lane's work at this instant in addition to the loop's rounds. Called only by lanes."""
        self._rounds += rounds

    def _take_last(self) -> None:
        self.ready.extend(self._last)
        self._last.clear()

    def _force_time_forward(self) -> None:
        """Advance simulated time by one quantum at most, although events of this instant are left."""
        due, soon = self._timed.next_ns(), self._now + TICK_QUANTUM_NS
        self._now = soon if due is None else min(soon, max(due, self._now))
        self._rounds -= ROUNDS_PER_QUANTUM
        self._take_due()

    def _wait_for_event(self, due_ns: int | None) -> None:
        """Wait until ``due_ns``, for an event from another thread, or only briefly, so that Ctrl-C is noticed."""
        timeout = 0.2  # Python on Windows notices Ctrl-C only between waits
        if due_ns is not None and not self.simulated:
            timeout = min(timeout, (due_ns - self.now_ns()) / 1e9 / self.rate)
        if timeout > 0:
            self._inbox.wait(timeout)
            self._empty_inbox()
