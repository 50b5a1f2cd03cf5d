"""Calls from real threads to the scheduler's thread, and the reverse."""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]
import operator
import sys
import threading
from pathlib import Path
from signal import SIGINT
from typing import TYPE_CHECKING, Any, TypeVar, cast

from rosmini.core.errors import ROSInterruptException

from .lanes import Lane, LaneExit, Waiter
from .stacks import HAS_THREADS, GreenletExit, getcurrent, greenlet

if TYPE_CHECKING:
    import weakref
    from collections.abc import Callable
    from types import FrameType

    from .report import RunReport
    from .scheduler import Scheduler


class Worker(greenlet):  # type: ignore[misc] # greenlet has no types
    """A greenlet that runs a scheduler's loop."""

    scheduler: weakref.ref[Any]


_call: Any = operator.call  # mypy: any number of arguments
DEEP = (_call,) * 11
"""Calls in C between the bottom of a worker's stack and the code that it runs.

If numpy reuses the memory of an intermediate result of 256 kB or more, it inspects its ten innermost C callers.
Below the bottom of a greenlet's stack there are no callers: inspecting that memory crashes the process.
"""

_adopted = threading.local()
"""The scheduler for which a real thread works, if one has adopted the thread."""


def adopt_thread(scheduler: weakref.ref[Any] | None) -> None:
    """Set the scheduler for which the calling thread works."""
    _adopted.scheduler = scheduler


def running_scheduler() -> Any:
    """Return the scheduler that runs the caller, in a lane or in a thread that it adopted; otherwise None."""
    found = getattr(getcurrent(), "scheduler", None) or getattr(_adopted, "scheduler", None)
    return None if found is None else found()


def start_workers(worker: greenlet, creator: greenlet) -> None:
    """Start each greenlet that is passed in. This is the body of a separate greenlet."""
    while True:
        worker, creator = worker.switch(creator)


def work(creator: greenlet) -> None:
    """Run events until parked code must continue, switch to it, and wait to be used again. This is a worker's body."""
    run_events = creator.switch()
    del creator
    while True:
        resumed = _call(*DEEP, run_events)
        del run_events  # the garbage collector does not see the references of an idle worker
        run_events = resumed.switch()
        del resumed


PATIENCE_S = 1.0
"""Time after which a Ctrl-C without effect reports the code that is still running [s]."""

MAIN_THREAD = threading.main_thread().ident

# The functions of ``signal`` itself convert numbers to enums and back, which takes 5 us for each blocking call.
_get_handler, _set_handler, _SIGINT = _signal.getsignal, _signal.signal, int(SIGINT)


class InterruptGuard:
    """Turns the first SIGINT during a drive into a flag that the scheduler checks between two events.

    If the running callback does not return, a timer thread reports this, and a second SIGINT raises
    ``KeyboardInterrupt`` in the callback. Outside the main thread Python delivers no signals, and the guard does
    nothing.

    ``wake`` makes the scheduler check the flag; ``running`` names the running code.
    """

    def __init__(self, wake: Callable[[], None], running: Callable[[], str]) -> None:
        self._wake = wake
        self._running = running
        self._report_timer: threading.Timer | None = None
        self.noted = False
        """True if an interrupt has arrived that has not been taken yet."""
        self._depth = 0
        self._previous: Any = None

    def arm(self) -> None:
        """Catch SIGINT if this is the main thread and Python's handling is not disabled."""
        self._depth += 1
        if self._depth > 1 or threading.get_ident() != MAIN_THREAD:
            return
        if callable(_get_handler(_SIGINT)):
            self._previous = _set_handler(_SIGINT, self._handle)

    def disarm(self) -> None:
        """Restore the previous handler of SIGINT, at the outermost level."""
        self._depth -= 1
        if self._depth == 0 and self._previous is not None:
            _set_handler(_SIGINT, self._previous)
            self._previous = None

    def take(self) -> bool:
        """Return True if an interrupt was noted, and clear it."""
        noted, self.noted = self.noted, False
        if self._report_timer is not None:
            self._report_timer.cancel()
            self._report_timer = None
        return noted

    def _handle(self, _signum: int, frame: FrameType | None) -> None:
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        self._wake()
        place = users_place(frame)
        if place:
            self._report_timer = threading.Timer(PATIENCE_S, self._report, (place,))
            self._report_timer.daemon = True
            self._report_timer.start()

    def _report(self, place: str) -> None:
        if self.noted:
            sys.stderr.write(
                f"Ctrl-C: waiting for {self._running()} to come back from {place}. Press Ctrl-C again to end it at "
                "once.\n"
            )


def users_place(frame: FrameType | None) -> str:
    """Return the name and line of the outermost user function that runs in ``frame``.

    Empty for rosmini's own code.
    """
    found: FrameType | None = None
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if not module.startswith("rosmini."):
            found = frame
        elif found is not None and module.startswith("rosmini.core.graph."):
            break  # its caller
        frame = frame.f_back
    if frame is None or found is None:
        return ""
    code = found.f_code
    return f"{code.co_name} ({Path(code.co_filename).name}, line {found.f_lineno})"


T = TypeVar("T")

POLL_PERIOD_S = 0.005
"""Interval at which :func:`run_beside` checks whether the run is over [s]."""


def call_from_thread(scheduler: Scheduler, function: Callable[[], T]) -> T:
    """Return ``function()``, called through the inbox in a lane with the caller's node and context; blocks."""
    waiter = Waiter(scheduler, "the thread that runs the graph")
    caller = scheduler.current()

    def work() -> None:
        try:
            waiter.wake(function())
        except (LaneExit, GreenletExit):
            waiter.fail(ROSInterruptException("the graph was closed"))
            raise
        except BaseException as error:
            waiter.fail(error)

    lane = Lane(scheduler, caller.name, node=caller.node, context=caller.context)
    scheduler.call_soon_threadsafe(lambda: lane.submit(work))
    waiter.wait()
    return cast("T", waiter.value)


def complaint(scheduler: Scheduler, waiter: Waiter) -> Callable[[], None]:
    """Return a function that warns on standard error if no thread drives the graph that the caller waits for."""
    name = threading.current_thread().name

    def complain() -> None:
        if not scheduler.driven:
            sys.stderr.write(
                f"{name} waits for {waiter.reason}, but no thread drives the graph. "
                "Call graph.run(), or anything that blocks, in the thread that made the graph.\n"
            )

    return complain


def run_beside(scheduler: Scheduler, until_ns: int | None, until: Callable[[], bool] | None) -> RunReport:
    """Wait for the time or the condition while another thread drives in wall-clock time; return a report as ``run``."""
    waiter = Waiter(scheduler, "the end of the run")

    def poll() -> None:
        if until is not None and until():
            waiter.wake("condition")
        elif until_ns is not None and scheduler.now_ns() >= until_ns:
            waiter.wake("time")
        elif not waiter.done:
            soon = scheduler.now_ns() + int(POLL_PERIOD_S * 1e9 * scheduler.rate)
            scheduler.call_at(soon if until_ns is None else min(soon, until_ns), poll)

    scheduler.call_soon_threadsafe(poll)
    try:
        waiter.wait()
    finally:
        waiter.wake("stopped")
    return scheduler.report(waiter.value)


def in_thread(scheduler: Scheduler, function: Callable[[], T], *, hold: bool = True) -> T:
    """Return ``function()``, run in a helper thread while the lane is parked; ``hold`` stops simulated time.

    Where Python has no threads it runs at once.
    """
    if not HAS_THREADS:
        return function()
    waiter = Waiter(scheduler, "the operating system")
    if hold:
        scheduler.hold()

    def work() -> None:
        try:
            waiter.wake(function())
        except BaseException as error:
            waiter.fail(error)
        finally:
            if hold:
                scheduler.release()

    threading.Thread(target=work, name="rosmini-helper", daemon=True).start()
    waiter.wait()
    return cast("T", waiter.value)
