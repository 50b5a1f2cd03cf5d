"""The scheduler: one thread, one event queue, two clocks.

Everything that happens in a graph is an event in one queue ordered by (time, sequence number). In simulated time the
queue jumps from event to event, as fast as the machine allows and in the same order on each run; in wall-clock time
events wait until they are due. Code that blocks is parked (see :mod:`rosmini.core.graph.lanes`), and the queue
continues.

The loop has neither a thread nor a greenlet for itself: code that blocks hands the loop to a worker greenlet, which
runs the events, calls the callbacks directly, and is itself left parked when one of them blocks. A callback that does
not block therefore costs a function call, not a switch. The garbage collector does not see the references in the
frames of a suspended greenlet, so an idle worker holds no reference to the scheduler.
"""

from __future__ import annotations

import threading
import weakref
from _thread import get_ident
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

from rosmini.core.errors import GraphEnded, RosminiError

from . import threads
from .event_queue import ROUNDS_PER_INSTANT, TICK_QUANTUM_NS, EventQueue
from .lanes import Lane, LaneContext, LaneExit, RemoteWaiter, Waiter
from .notebook import CellOutput, kernel_shell
from .report import RunReport, Waiting, ended
from .stacks import getcurrent, greenlet
from .threads import MAIN_THREAD, InterruptGuard, Worker, adopt_thread, start_workers, work

T = TypeVar("T")
E = TypeVar("E", bound=BaseException)

ROUNDS_PER_POLL = 16
"""Number of rounds after which the loop checks timers and other threads while lanes only wake one another."""

TICKS_PER_YIELD = 1_000
"""Ticks, about a microsecond each, that a polling loop uses before the other lanes run."""

FREE_TURNS = 100
"""Number of consecutive turns of a loop, without a blocking call, in which calls of ROS cost no ticks."""

CALL_TICKS = 49
"""Ticks charged for a publish, a printed line or a lookup: 50 us with the turn itself. In rospy it takes 85 us."""

POLLING_TICKS = 3_000_000
"""Ticks that calls of ROS use without a blocking call before the script is warned that it keeps polling."""


class Scheduler(EventQueue):
    """Runs lanes and timed events; see the module's docstring.

    Args:
        simulated: jump from event to event instead of waiting for the wall clock.
        rate: in wall-clock time, the seconds of graph time that pass in one second.

    """

    def __init__(self, *, simulated: bool = True, rate: float = 1.0) -> None:
        super().__init__(simulated=simulated, rate=rate)
        self.trace: Callable[[int, str], None] | None = None
        self.on_error: Callable[[Lane, BaseException], None] | None = None
        self.ask_driver: Callable[[Waiter], Callable[[], None]] = partial(threads.complaint, self)
        """Finds a driver while another thread waits; the function that it returns is called if the wait takes long."""
        self.graph: Any = None
        """The graph that this scheduler runs, if any."""
        self.history: Any = None
        """The ``History`` that records the events of the graph, or None."""
        self._reference = weakref.ref(self)
        self._home = self.thread
        self._owner_lock = threading.Lock()
        self._idle: list[greenlet] = []
        self._starter: greenlet | None = None
        self._parked: dict[Waiter, Lane] = {}
        self._thread_lanes: dict[int, Lane] = {}
        self._ticks = TICKS_PER_YIELD
        self._turns = 0
        self._charged = 0
        self.root = Lane(self, "main")
        self._current = self.root
        self._context: LaneContext | None = None
        self._root_waiter: Waiter | None = None
        self._until: Callable[[], bool] | None = None
        self._left = 0
        shell = kernel_shell()
        self._output = None if shell is None else CellOutput(shell)
        self._interrupts = InterruptGuard(lambda: self._inbox.put(None), lambda: self._current.name)

    # -- current lane --------------------------------------------------------------------------------------------

    def current(self) -> Lane:
        """Return the caller's lane, or the main program's if it is in none."""
        ident = get_ident()
        return self._current if ident == self.thread else self._thread_lanes.get(ident, self.root)

    def adopt_thread(self, name: str, *, node: Any = None, context: LaneContext | None = None) -> Lane:
        """Set the node and the script for which the calling thread works; return its lane.

        Undo this with :meth:`release_thread`.
        """
        lane = Lane(self, name, node=node, context=context)
        self._thread_lanes[get_ident()] = lane
        adopt_thread(self._reference)
        return lane

    def release_thread(self) -> None:
        """Undo :meth:`adopt_thread` for the calling thread."""
        self._thread_lanes.pop(get_ident(), None)
        adopt_thread(None)

    def spawn(
        self,
        name: str,
        task: Callable[[], object] | None = None,
        *,
        node: Any = None,
        context: LaneContext | None = None,
        on_error: Callable[[BaseException], None] | None = None,
    ) -> Lane:
        """Return a new lane, which runs ``task`` if given; by default node and context are the caller's."""
        parent = self.current()
        lane = Lane(
            self,
            name,
            node=parent.node if node is None else node,
            context=parent.context if context is None else context,
            on_error=on_error,
        )
        if task is not None:
            lane.submit(task)
        return lane

    def waiter(self, reason: str, *, remote: bool = False) -> Waiter:
        """Return a new :class:`Waiter`; ``reason`` completes "... was waiting for".

        ``remote``: True if it is woken from outside this process (see :class:`~rosmini.core.graph.lanes.RemoteWaiter`).
        """
        return RemoteWaiter(self, reason) if remote else Waiter(self, reason)

    def run_in_scheduler(self, function: Callable[..., T], *arguments: Any) -> T:
        """Return ``function(*arguments)``, run in the scheduler's thread, in a lane with the caller's node and context.

        A call from another thread goes through the inbox and waits for the result. If no thread drives, it soon warns
        about the wait; in wall-clock time it instead takes over the scheduler for the duration of the call.
        """
        if get_ident() == self.thread:
            return function(*arguments)
        if not self.acquire_scheduler(to_wait=True):
            return threads.call_from_thread(self, partial(function, *arguments))
        try:
            return function(*arguments)
        finally:
            self._release_scheduler()

    # -- blocking ------------------------------------------------------------------------------------------------

    def sleep_until(self, when_ns: int, reason: str | None = None) -> None:
        """Block until graph time ``when_ns``; ``reason`` completes "... was waiting for"."""
        timeout = when_ns - self.now_ns()
        Waiter(self, reason or "time to pass").wait(max(timeout, 0))

    def turn(self, *, is_idle: bool = False) -> None:
        """Count one turn of a loop that may never block; ``is_idle``: its body does nothing, so it only waits."""
        self._turns += 1
        if is_idle:
            self.charge(CALL_TICKS)
        self.tick()

    def tick(self, weight: int = 1) -> None:
        """Use ``weight`` ticks; from time to time, let the other lanes run and time advance."""
        self._ticks -= weight
        if self._ticks <= 0:
            self._ticks = TICKS_PER_YIELD
            if get_ident() == self.thread:
                self._yield()

    def charge(self, ticks: int) -> None:
        """Charge a loop that does not block for a call: ``ticks`` is its duration on a real computer [us].

        This does not yield: the loop's next turn does.
        """
        if self._turns > FREE_TURNS:
            self._ticks -= ticks
            self._charged += ticks

    def _yield(self) -> None:
        """Let the other lanes run. The lane continues as one that has not blocked."""
        context, turns, charged = self._current.context, self._turns, self._charged
        if self.simulated:
            self.sleep_until(self._now + TICK_QUANTUM_NS, "its turn in a polling loop")
        else:
            self.yield_to_others()
        self._turns, self._charged = turns, charged
        if self.simulated and charged >= POLLING_TICKS and context is not None:
            context.keeps_polling()

    def yield_to_others(self) -> None:
        """Let all other due events and lanes run before the caller continues. No effect in another thread."""
        if self.is_scheduler_thread():
            waiter = Waiter(self, "its turn")
            waiter.done = waiter.queued = True
            self._inbox.put(partial(self.ready.append, waiter.resume))
            self.park(waiter)
            if self._current.dead:
                raise LaneExit(f"lane {self._current.name} was asked to end")

    def in_thread(self, function: Callable[[], T]) -> T:
        """Return ``function()``, a blocking call of the operating system, run in a thread; the caller is parked."""
        return threads.in_thread(self, function) if self.is_scheduler_thread() else function()

    def acquire_scheduler(self, *, to_wait: bool = False) -> bool:
        """Move the scheduler to the calling thread, which is about to drive; return False if it is bound to another.

        ``to_wait``: the caller would drive only because it waits. In simulated time only the thread that made the graph
        advances time in this way, while it lives: the order of events must not depend on a race. After such a drive
        the scheduler returns to that thread.
        """
        if self._output is not None and self.is_in_main_thread():
            return False  # the kernel's main thread may be busy, and will drive when asked to
        with self._owner_lock:
            if not self._lives(self.thread):
                self._abandon()
            elif self.driven or self._parked or get_ident() in self._thread_lanes or (to_wait and self.simulated):
                return False
            self._bind_to_thread(get_ident())
        return True

    @staticmethod
    def _lives(ident: int) -> bool:
        return any(thread.ident == ident for thread in threading.enumerate())

    def _bind_to_thread(self, ident: int) -> None:
        self._idle.clear()  # greenlets are bound to their thread
        self._starter = None
        self.thread = ident

    def _abandon(self) -> None:
        """Drop the code that was parked in a thread that has ended: it cannot be resumed."""
        for waiter, lane in self._parked.items():
            waiter.greenlet = None
            lane.dead = True
        self._parked.clear()
        self._root_waiter = None

    def park(self, waiter: Waiter) -> bool:
        """Park the caller until ``waiter`` resumes it, and run the queue meanwhile. Called only by waiters.

        Return False at once if another thread has just begun to drive.
        """
        lane = self.current()
        if lane is self.root and not self._start_drive(waiter):
            return False
        waiter.greenlet = getcurrent()
        lane.waiter = waiter
        lane.parks += 1
        self._parked[waiter] = lane
        try:
            worker = self._idle.pop() if self._idle else self._new_worker()
            if self._output is not None:
                self._output.use_driver_context(worker)
            worker.switch(self._run_events)
        finally:
            del self._parked[waiter]
            waiter.greenlet = lane.waiter = None
            if waiter.cause is not None:
                lane.woken = self.now_ns(), waiter.cause
            self.enter_lane(lane)
            if lane is self.root:
                self._end_drive()
            elif self._output is not None:
                self._output.redirect_to_driving_cell()
        if lane is self.root and self._interrupts.take():
            raise self._interruption()
        return True

    def _new_worker(self) -> greenlet:
        """Return a worker started at the call depth of the first one: a greenlet counts its depth from there.

        Otherwise each blocked worker would start where the last one stopped, and many would reach the recursion limit.
        """
        worker = Worker(work)
        worker.scheduler = self._reference
        if self._starter is None:
            self._starter = greenlet(start_workers)
        self._starter.switch(worker, getcurrent())
        return worker

    def _start_drive(self, waiter: Waiter) -> bool:
        """Start to drive for a waiter, unless already done; return False if another thread drives."""
        if self._root_waiter is waiter:
            return True
        with self._owner_lock:
            if not self.is_scheduler_thread():
                if self.driven or self._parked:
                    return False
                self._bind_to_thread(get_ident())  # the other thread was not driving
            self._root_waiter = waiter
        self._left = len(self.ready)
        self._interrupts.arm()
        if self._output is not None:
            self._output.begin()
        return True

    def _end_drive(self) -> None:
        self._root_waiter = None
        self._interrupts.disarm()
        if self.thread != MAIN_THREAD:
            self._end_workers()  # no other thread could use them
            self._release_scheduler()

    def _release_scheduler(self) -> None:
        """Give the scheduler back to the thread that made the graph, unless code is parked in this thread."""
        with self._owner_lock:
            if self.thread != self._home and not self._parked and self._lives(self._home):
                self._bind_to_thread(self._home)

    # -- called by lanes and waiters -----------------------------------------------------------------------------

    def enter_lane(self, lane: Lane) -> None:
        """Make ``lane`` the running one, with its context. Called only by lanes and the scheduler."""
        self._current = lane
        self._ticks = TICKS_PER_YIELD
        self._turns = self._charged = 0
        if lane.context is not self._context:
            self._swap_context(lane.context)
        if self.trace is not None:
            self.trace(self.now_ns(), lane.name)

    def _swap_context(self, context: LaneContext | None) -> None:
        if self._context is not None:
            self._context.leave()
        self._context = context
        if context is not None:
            context.enter()

    def lane_failed(self, lane: Lane, error: BaseException) -> None:
        """Report an exception of a task of ``lane``. Called only by lanes."""
        if isinstance(error, KeyboardInterrupt) and self._interrupts.noted:
            if lane.context is not None:
                lane.context.cut_short()
            return
        if lane.on_error is not None:
            lane.on_error(error)
        elif self.on_error is not None:
            self.on_error(lane, error)
        else:
            self.raise_in_driver(error)

    def raise_in_driver(self, error: BaseException) -> bool:
        """Raise ``error`` at the call that drives the queue; return False if that already ends for another reason."""
        waiter = self._root_waiter
        if waiter is None:
            raise self._shortened(error)
        if waiter.done:
            return False
        waiter.fail(self._shortened(error))
        return True

    # -- driving -------------------------------------------------------------------------------------------------

    @property
    def driven(self) -> bool:
        """True while a thread drives the queue."""
        return self._root_waiter is not None

    def run(self, until_ns: int | None = None, until: Callable[[], bool] | None = None) -> RunReport:
        """Drive the queue until graph time ``until_ns``, ``until()`` is true, or (in simulated time) no event is left.

        Call it only in the main program, a notebook cell, or a thread while no other thread drives: otherwise it raises
        ``RosminiError``, or, beside another driving thread in wall-clock time, only waits.
        """
        is_free = self.is_scheduler_thread() or self.acquire_scheduler()
        if is_free and self.current() is self.root and until is not None and until():
            self._release_scheduler()
            return self.report("condition")
        waiter = Waiter(self, "the end of the run")
        if not is_free or self.current() is not self.root or not self._start_drive(waiter):
            return self._run_beside(until_ns, until)
        timer = None if until_ns is None else self.call_at(until_ns, partial(waiter.wake, "time"))
        self._until = until
        try:
            waiter.wait()
        except GraphEnded:
            return self.report("drained")
        finally:
            self._until = None
            if timer is not None:
                timer.cancel()
        return self.report(waiter.value)

    def _run_beside(self, until_ns: int | None, until: Callable[[], bool] | None) -> RunReport:
        """Run while another thread drives, which is allowed in wall-clock time only."""
        if not self.simulated and self.current() is self.root:
            return threads.run_beside(self, until_ns, until)
        msg = (
            "run() was called from inside the graph (a callback or a script), or while another thread drives it; only "
            "the main program drives it. In a callback, block with sleep() or wait_for_message() instead."
        )
        raise RosminiError(msg)

    def stop(self) -> None:
        """End the current :meth:`run`, from any thread or lane."""
        if self._root_waiter is not None:
            self._root_waiter.wake("stopped")

    def report(self, reason: str) -> RunReport:
        """Return a report on a run that has just ended for ``reason``."""
        return RunReport(reason, self.now_ns() / 1e9, self.waiting())

    def waiting(self) -> tuple[Waiting, ...]:
        """Return the parked lanes, without the driver, and the reason why each waits."""
        return tuple(
            Waiting(lane.name, waiter.reason) for waiter, lane in self._parked.items() if lane is not self.root
        )

    def close(self) -> None:
        """End every lane. The scheduler can be used again afterwards."""
        for waiter, lane in list(self._parked.items()):
            if lane is not self.root:
                lane.dead = True
                waiter.fail(LaneExit("the graph was closed"))
        if self.is_scheduler_thread() and self._current is self.root:
            for _ in range(3):  # a lane may block again while it cleans up
                if not any(lane is not self.root for lane in self._parked.values()):
                    break
                self.run(until_ns=self.now_ns())
            self._end_workers()
        self.ready.clear()
        self._timed.clear()
        self._last.clear()

    def _end_workers(self) -> None:
        """End the idle greenlets: the garbage collector does not see the references of a suspended one."""
        if self._starter is not None:
            self._idle.append(self._starter)
            self._starter = None
        while self._idle:
            worker = self._idle.pop()
            worker.parent = getcurrent()  # a greenlet returns to its parent when it ends
            worker.throw()

    def _interruption(self) -> KeyboardInterrupt:
        return self._shortened(KeyboardInterrupt())

    def _shortened(self, error: E) -> E:
        if self._output is not None:
            self._output.shorten(error)
        return error

    # -- the loop ------------------------------------------------------------------------------------------------

    def _run_events(self) -> greenlet:
        """Run events until parked code must continue; return that code."""
        ready, heap, simulated = self.ready, self._timed.heap, self.simulated
        nothing_came, interrupts = self._inbox.empty, self._interrupts
        if not self._left and (self._rounds + 1) % ROUNDS_PER_POLL:  # skip the inbox and the timers in most rounds
            self._rounds += 1
            self._left = len(ready)
        while True:
            try:
                while True:
                    while self._left and ready:
                        self._left -= 1
                        parked = ready.popleft()()
                        if parked is not None and isinstance(parked, greenlet):
                            self._idle.append(getcurrent())
                            return parked
                        if self._until is not None:
                            self._check_until()
                    self._rounds += 1
                    if self._until is not None:
                        self._check_until()
                    if interrupts.noted or not nothing_came():
                        self._take_inbox()
                    if heap and (not simulated or heap[0][0] <= self._now):
                        self._take_due()
                    if self._rounds > ROUNDS_PER_INSTANT and simulated:
                        self._force_time_forward()
                    if not ready:
                        self._advance()
                    self._left = len(ready)
            except KeyboardInterrupt:
                interrupts.noted = True
            except Exception as error:
                self.raise_in_driver(error)

    def _check_until(self) -> None:
        if self._until is not None and self._until():
            self._until = None
            if self._root_waiter is not None:
                self._root_waiter.wake("condition")

    def _take_inbox(self) -> None:
        root = self._root_waiter
        if root is not None and not root.done and self._interrupts.take():
            root.fail(self._interruption())
        self._empty_inbox()

    def _advance(self) -> None:
        """Advance to the next event, wait for it, or end the run, since no event is due now."""
        if self._last:
            self._take_last()
            return
        due = self._timed.next_ns()
        if self.simulated and not self._holds:
            if due is not None:
                self._now = due
                self._rounds = 0
                if self._until is None:  # otherwise it is checked before any event of that time runs
                    self._timed.take_due(due, self.ready)
            elif self._remote_waits:
                self._wait_for_event(None)
            elif self._root_waiter is not None and not self._root_waiter.done:
                self._root_waiter.fail(ended(self._root_waiter.reason, self.waiting()))
            return
        self._wait_for_event(due)
