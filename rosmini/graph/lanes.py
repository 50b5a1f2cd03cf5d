"""Lanes: the threads of control of a graph, run one at a time by the scheduler.

A lane is a queue of tasks that run first in, first out. Two lanes interleave only where one of them blocks
(``rate.sleep``, a service call, ``spin``): the blocked one is parked, a greenlet, and the queue goes on. Code that
blocks therefore reads like a threaded ROS node, and runs in the same order each time.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, Any, Protocol

from greenlet import GreenletExit

if TYPE_CHECKING:
    from collections.abc import Callable

    from greenlet import greenlet

    from .scheduler import Scheduler


PATIENCE_S = 2.0
"""After how long a call that waits in another thread asks why."""


TURNS = 1_000
"""So many tasks a lane runs before the others get their turn."""


class LaneExit(BaseException):
    """Thrown into a lane that is asked to end, at the place where it blocks."""


class LaneContext(Protocol):
    """What has to be swapped in and out when a lane runs: a script's ``sys.argv``, its modules, its random state."""

    def enter(self) -> None:
        """Make this context the one that Python code sees."""

    def leave(self) -> None:
        """Put back what was there before."""

    def cut_short(self) -> None:
        """Learn that a second Ctrl-C ended what a lane of it was running."""


class Lane:
    """A first-in, first-out queue of tasks with one blocking point.

    ``node`` is the ROS node that the lane works for, ``context`` the script it belongs to; both are inherited by lanes
    that are created from it. ``on_error`` gets an exception that a task lets out; without it the exception is raised at
    the call that drives the graph.
    """

    __slots__ = (
        "_activate_ref",
        "_busy",
        "_scheduler",
        "_tasks",
        "_waiter",
        "context",
        "dead",
        "name",
        "node",
        "on_error",
        "on_exit",
    )

    def __init__(
        self,
        scheduler: Scheduler,
        name: str,
        *,
        node: Any = None,
        context: LaneContext | None = None,
        on_error: Callable[[BaseException], None] | None = None,
    ) -> None:
        self._scheduler = scheduler
        self.name = name
        self.node = node
        self.context = context
        self.on_error = on_error
        self.on_exit: Callable[[], None] | None = None
        self.dead = False
        self._tasks: deque[Callable[[], object]] = deque()
        self._busy = False
        self._waiter: Waiter | None = None
        self._activate_ref = self._activate

    def __repr__(self) -> str:
        state = "ended" if self.dead else f"waiting for {self.waiting_for}" if self._waiter else "idle"
        return f"<lane {self.name}: {state}>"

    @property
    def idle(self) -> bool:
        """True when the lane has nothing to run and is not parked in the middle of a task."""
        return not self._busy

    @property
    def waiting_for(self) -> str | None:
        """What the lane is parked for, in words, or None."""
        waiter = self._waiter
        return None if waiter is None else waiter.reason

    def submit(self, task: Callable[[], object]) -> None:
        """Queue ``task``; it runs after the ones before it. From any thread. A dead lane ignores it."""
        scheduler = self._scheduler
        if not scheduler.is_hub_thread():
            scheduler.call_soon_threadsafe(lambda: self.submit(task))
            return
        self.post(task)

    def post(self, task: Callable[[], object]) -> None:
        """Do as :meth:`submit` does, in the hub's thread only."""
        if self.dead:
            return
        self._tasks.append(task)
        if not self._busy:
            self._busy = True
            self._scheduler.ready.append(self._activate_ref)

    def kill(self) -> None:
        """End the lane: forget its queued tasks and throw :class:`LaneExit` where it is parked."""
        if self.dead:
            return
        self.dead = True
        self._tasks.clear()
        if self._waiter is not None:
            self._waiter.fail(LaneExit(f"lane {self.name} was asked to end"))
        elif not self._busy:
            self._ended()

    def _activate(self) -> None:
        """Run the queued tasks. Called by the scheduler only, in one of its worker greenlets."""
        scheduler = self._scheduler
        scheduler.enter_lane(self)
        tasks = self._tasks
        turns = TURNS
        while tasks:
            if not turns:  # a lane that keeps giving itself work starves nobody
                scheduler.count_rounds(TURNS)
                scheduler.ready.append(self._activate_ref)
                return
            turns -= 1
            task = tasks.popleft()
            try:
                task()
            except LaneExit:
                self.dead = True
                tasks.clear()
            except GreenletExit:  # nobody holds the graph any more: it must not go on while it is swept away
                self.dead = True
                raise
            except BaseException as error:
                scheduler.lane_failed(self, error)
        self._busy = False
        if self.dead:
            self._ended()

    def _ended(self) -> None:
        if self.on_exit is not None:
            on_exit, self.on_exit = self.on_exit, None
            on_exit()


class Waiter:
    """One thing that somebody blocks for: woken once, with a value or an error, from any thread.

    ``wait`` works from a lane (which is parked), from the main program or a notebook cell (which drives the queue
    meanwhile), and from a real thread (which sleeps).
    """

    __slots__ = ("_error", "_event", "_greenlet", "_queued", "_scheduler", "done", "reason", "value")

    def __init__(self, scheduler: Scheduler, reason: str) -> None:
        self._scheduler = scheduler
        self.reason = reason
        self.done = False
        self.value: Any = None
        self._error: BaseException | None = None
        self._greenlet: greenlet | None = None
        self._event: threading.Event | None = None
        self._queued = False

    def wake(self, value: Any = None) -> None:
        """Let the waiting code go on; ``value`` is kept in :attr:`value`. Later calls do nothing."""
        self._finish(value, None)

    def fail(self, error: BaseException) -> None:
        """Raise ``error`` in the waiting code."""
        self._finish(None, error)

    def _finish(self, value: Any, error: BaseException | None) -> None:
        scheduler = self._scheduler
        if not scheduler.is_hub_thread():
            scheduler.call_soon_threadsafe(lambda: self._finish(value, error))
            return
        if self.done:
            return
        self.value = value
        self._error = error
        self.done = True
        if self._event is not None:
            self._event.set()
        elif self._greenlet is not None and not self._queued:
            self._queued = True
            scheduler.ready.append(self._resume)

    @property
    def settled(self) -> bool:
        """True when a thread that waited goes on: woken, failed or timed out."""
        event = self._event
        return self.done or event is None or event.is_set()

    def _resume(self) -> greenlet | None:
        """Return the code to go on with; the loop switches to it, and then holds nothing of this waiter."""
        self._queued = False
        return self._greenlet

    def wait(self, timeout_ns: int | None = None) -> bool:
        """Block until woken (True) or until ``timeout_ns`` of graph time have passed (False).

        Raises what :meth:`fail` was given, and :class:`~rosmini.errors.GraphEnded` when the main program waits in
        simulated time and nothing is left that could wake it.
        """
        scheduler = self._scheduler
        if self.done:
            return self._outcome()
        if scheduler.may_wait():
            timer = None
            if timeout_ns is not None:
                timer = scheduler.call_at(scheduler.now_ns() + timeout_ns, self._timed_out)
            try:
                scheduler.park(self)
            finally:
                if timer is not None:
                    timer.cancel()
        else:
            self._wait_in_thread(timeout_ns)
        return self._outcome()

    def _timed_out(self) -> None:
        """Resume the waiting code without marking the waiter as done."""
        if self.done or self._queued:
            return
        if self._event is not None:
            self._event.set()
        elif self._greenlet is not None:
            self._queued = True
            self._scheduler.ready.append(self._resume)

    def _outcome(self) -> bool:
        if self._error is not None:
            raise self._error
        return self.done

    def _wait_in_thread(self, timeout_ns: int | None) -> None:
        scheduler = self._scheduler
        event = threading.Event()
        self._event = event
        try:
            if self.done:
                return
            limit = None
            if timeout_ns is not None and scheduler.simulated:
                when = scheduler.now_ns() + timeout_ns
                scheduler.call_soon_threadsafe(lambda: scheduler.call_at(when, self._timed_out))
            elif timeout_ns is not None:
                limit = timeout_ns / 1e9 / scheduler.rate
            complain = scheduler.ask_driver(self)
            patience = PATIENCE_S if limit is None else min(limit, PATIENCE_S)
            if not event.wait(patience):
                complain()
                event.wait(None if limit is None else limit - patience)
        finally:
            self._event = None
