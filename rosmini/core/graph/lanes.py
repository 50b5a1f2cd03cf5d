"""Lanes: the threads of control of a graph, run one at a time by the scheduler.

A lane is a queue of tasks that run first in, first out. Two lanes interleave only where one of them blocks
(``rate.sleep``, a service call, ``spin``): it is parked as a greenlet, and the queue continues. Code that
blocks therefore reads like a threaded ROS node, and runs in the same order each time.
"""

from __future__ import annotations

import threading
import time
from _thread import get_ident
from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from .stacks import GreenletExit

if TYPE_CHECKING:
    from collections.abc import Callable

    from .scheduler import Scheduler
    from .stacks import greenlet


PATIENCE_S = 2.0
"""Time after which a call that waits in another thread reports why it waits [s]."""

POLL_PERIOD_S = 0.05
"""Interval at which a waiting thread checks, in wall time, whether the driver has stopped and it must take over [s]."""


TURNS = 1_000
"""Number of tasks that a lane runs before the others get their turn."""


class LaneExit(BaseException):
    """Thrown into a lane that is asked to end, at the point where it blocks."""


class LaneContext(Protocol):
    """The state that is swapped when a lane runs: a script's ``sys.argv``, its modules, its random state."""

    def enter(self) -> None:
        """Make this context the one that Python code sees."""

    def leave(self) -> None:
        """Restore the previous state."""

    def cut_short(self) -> None:
        """Called when a second Ctrl-C has ended the code that one of its lanes was running."""

    def keeps_polling(self) -> None:
        """Called in a running lane whose loop has continued for long without a blocking call."""


class Lane:
    """A first-in, first-out queue of tasks, which run one after another. While a task blocks, the others wait.

    ``node`` is the ROS node that the lane works for, ``context`` the script it belongs to; lanes that are created from
    it inherit both. ``on_error`` is called with an exception that a task raises; without it the exception is raised at
    the call that drives the graph.
    """

    __slots__ = (
        "_activate_ref",
        "_busy",
        "_scheduler",
        "_tasks",
        "cause",
        "context",
        "dead",
        "name",
        "node",
        "on_error",
        "on_exit",
        "parks",
        "waiter",
        "woken",
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
        self.waiter: Waiter | None = None
        """The waiter for which the lane is parked. Set by the scheduler only."""
        self.parks = 0
        """The number of times that the lane has blocked. Set by the scheduler only."""
        self.cause: int | None = None
        """Number of the event that its task acts on, if the graph is recording."""
        self.woken: tuple[int, int] | None = None
        """The time at which an event woke the lane, and the number of that event."""
        self._activate_ref = self._activate

    def __repr__(self) -> str:
        state = "ended" if self.dead else f"waiting for {self.waiting_for}" if self.waiter else "idle"
        return f"<lane {self.name}: {state}>"

    @property
    def idle(self) -> bool:
        """True if the lane has nothing to run and is not parked in a task."""
        return not self._busy

    @property
    def waiting_for(self) -> str | None:
        """What the lane is parked for, in words, or None."""
        waiter = self.waiter
        return None if waiter is None else waiter.reason

    def submit(self, task: Callable[[], object]) -> None:
        """Queue ``task`` after the earlier ones. Safe in any thread. A dead lane ignores it."""
        scheduler = self._scheduler
        if get_ident() != scheduler.thread:
            scheduler.call_soon_threadsafe(lambda: self.submit(task))
            return
        if scheduler.history is not None:
            task = partial(self._on_behalf, scheduler.history.cause(), task)
        self.post(task)

    def _on_behalf(self, cause: int | None, task: Callable[[], object]) -> None:
        """Run a task that acts on the same event as the code that submitted it."""
        self.cause = cause
        try:
            task()
        finally:
            self.cause = None

    def post(self, task: Callable[[], object]) -> None:
        """Like :meth:`submit`, but in the scheduler's thread only."""
        if self.dead:
            return
        self._tasks.append(task)
        if not self._busy:
            self._busy = True
            self._scheduler.ready.append(self._activate_ref)

    def post_if_idle(self, task: Callable[[], object]) -> bool:
        """Queue ``task`` if nothing is queued or running; return True if so. In the scheduler's thread only."""
        if self._busy or self.dead:
            return False
        self._busy = True
        self._tasks.append(task)
        self._scheduler.ready.append(self._activate_ref)
        return True

    def kill(self) -> None:
        """End the lane: drop its queued tasks and throw :class:`LaneExit` where it is parked."""
        if self.dead:
            return
        self.dead = True
        self._tasks.clear()
        if self.waiter is not None:
            self.waiter.fail(LaneExit(f"lane {self.name} was asked to end"))
        elif not self._busy:
            self._ended()

    def _activate(self) -> None:
        """Run the queued tasks. Called by the scheduler only, in one of its worker greenlets."""
        scheduler = self._scheduler
        scheduler.enter_lane(self)
        tasks = self._tasks
        turns = TURNS
        while tasks:
            if not turns:  # a lane that keeps giving itself work must not starve the others
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
            except GreenletExit:  # the graph is being garbage-collected: its code must not continue
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
    """One blocking wait, which any thread can end once, with a value or an error.

    ``wait`` works in a lane, which is parked; in the main program or a notebook cell, which drives the queue meanwhile;
    and in another thread, which sleeps while the queue is driven. In wall time, if nothing drives the queue, that
    thread drives it until it is woken.
    """

    __slots__ = ("_error", "_event", "_scheduler", "cause", "done", "greenlet", "queued", "reason", "value")

    def __init__(self, scheduler: Scheduler, reason: str) -> None:
        self._scheduler = scheduler
        self.reason = reason
        self.done = False
        self.value: Any = None
        self._error: BaseException | None = None
        self._event: threading.Event | None = None
        self.greenlet: greenlet | None = None
        """The parked code. For the scheduler only, as is :attr:`cause`."""
        self.cause: int | None = None
        """Number of the event that woke it, if the graph is recording."""
        self.queued = False
        """True if :meth:`resume` is among the events that are due."""

    def wake(self, value: Any = None) -> None:
        """Let the waiting code continue; ``value`` is stored in :attr:`value`. Later calls have no effect."""
        self._finish(value, None)

    def fail(self, error: BaseException) -> None:
        """End the wait by raising ``error`` in the waiting code. No effect after the wait has ended."""
        self._finish(None, error)

    def _finish(self, value: Any, error: BaseException | None) -> None:
        scheduler = self._scheduler
        if get_ident() != scheduler.thread:
            scheduler.call_soon_threadsafe(lambda: self._finish(value, error))
        elif not self.done:
            self.value = value
            self._error = error
            self.done = True
            if scheduler.history is not None:
                self.cause = scheduler.history.cause()
            self._go_on()

    def _go_on(self) -> None:
        if self._event is not None:
            self._event.set()
        elif self.greenlet is not None and not self.queued:
            self.queued = True
            self._scheduler.ready.append(self.resume)

    @property
    def settled(self) -> bool:
        """True if a thread that waited can continue: it was woken, has failed or has timed out."""
        event = self._event
        return self.done or event is None or event.is_set()

    def resume(self) -> greenlet | None:
        """Return the greenlet to resume; the loop switches to it without keeping a reference to this waiter."""
        self.queued = False
        return self.greenlet

    def wait(self, timeout_ns: int | None = None) -> bool:
        """Block until woken (True) or until ``timeout_ns`` of graph time have passed (False).

        Raises the error given to :meth:`fail`, and :class:`~rosmini.core.errors.GraphEnded` if the main program waits
        in simulated time and nothing is left that could wake it.
        """
        scheduler = self._scheduler
        end = None if timeout_ns is None else scheduler.now_ns() + timeout_ns
        while not self.done:
            drives = (
                get_ident() == scheduler.thread
                or scheduler.acquire_scheduler(to_wait=True)
                or self._wait_in_thread(end)
            )
            if not drives or self.done or self._park(end):
                break
        if self._error is not None:
            raise self._error
        return self.done

    def _park(self, end_ns: int | None) -> bool:
        scheduler = self._scheduler
        if end_ns is None:
            return scheduler.park(self)
        timer = scheduler.call_at(end_ns, self._time_out)
        try:
            return scheduler.park(self)
        finally:
            timer.cancel()

    def _time_out(self) -> None:
        """Resume the waiting code without marking the waiter as done."""
        if not self.done:
            self._go_on()

    def _wait_in_thread(self, end_ns: int | None) -> bool:
        """Sleep while another thread drives; return True if none does any longer and this thread now drives."""
        scheduler = self._scheduler
        event = self._event = threading.Event()
        try:
            if self.done:
                return False
            if end_ns is not None and scheduler.simulated:
                scheduler.call_soon_threadsafe(lambda: scheduler.call_at(end_ns, self._time_out))
            complain: Callable[[], None] | None = scheduler.ask_driver(self)
            impatient = time.monotonic() + PATIENCE_S
            pause = POLL_PERIOD_S
            while not event.wait(pause):
                if not scheduler.simulated:
                    if end_ns is not None:
                        left = (end_ns - scheduler.now_ns()) / 1e9 / scheduler.rate
                        if left <= 0:
                            return False
                        pause = min(pause, left)
                    if get_ident() == scheduler.thread or scheduler.acquire_scheduler(to_wait=True):
                        return True
                if complain is not None and time.monotonic() > impatient:
                    complain()
                    complain = None
            return False
        finally:
            self._event = None


class RemoteWaiter(Waiter):
    """Waits for a response from outside this process; the code that wakes it has a wall-clock timeout.

    Simulated time continues meanwhile, because the other end may need it. If nothing else is left to do, the queue
    waits for the response instead of ending.
    """

    __slots__ = ()

    def wait(self, timeout_ns: int | None = None) -> bool:
        """Block as :meth:`Waiter.wait` does, with the same result and errors."""
        self._scheduler.count_remote(1)
        try:
            return super().wait(timeout_ns)
        finally:
            self._scheduler.count_remote(-1)
