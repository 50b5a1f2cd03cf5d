"""How real threads have something done by the scheduler's thread, and the other way round."""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]
import operator
import sys
import threading
from pathlib import Path
from signal import SIGINT
from typing import TYPE_CHECKING, Any, TypeVar, cast

from greenlet import GreenletExit, getcurrent, greenlet

from rosmini.core.errors import ROSInterruptException

from .lanes import Lane, LaneExit, Waiter

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

Where numpy reuses the memory of an intermediate result of 256 kB or more, it looks at its ten innermost callers in C.
What lies below the bottom of a greenlet's stack is no stack of callers: who reads on there crashes the process.
"""

_adopted = threading.local()
"""The scheduler for which a real thread works, if one has adopted it."""


def adopt_thread(scheduler: weakref.ref[Any] | None) -> None:
    """Note for which scheduler the calling thread works."""
    _adopted.scheduler = scheduler


def running_scheduler() -> Any:
    """Return the scheduler that runs the caller: a lane, or a thread that it adopted; None for anybody else."""
    found = getattr(getcurrent(), "scheduler", None) or getattr(_adopted, "scheduler", None)
    return None if found is None else found()


def start_workers(worker: greenlet, creator: greenlet) -> None:
    """Start each greenlet that is given. The body of a greenlet of its own."""
    while True:
        worker, creator = worker.switch(creator)


def work(creator: greenlet) -> None:
    """Run events until some parked code is to go on, switch to that, and wait to be used again. A worker's body."""
    run_events = creator.switch()
    del creator
    while True:
        resumed = _call(*DEEP, run_events)
        del run_events  # what an idle worker refers to, nobody could collect
        run_events = resumed.switch()
        del resumed


PATIENCE_S = 1.0
"""After how long a Ctrl-C that has not ended anything yet says what it waits for."""

MAIN_THREAD = threading.main_thread().ident

# The functions of ``signal`` itself turn numbers into enums and back: 5 us, each time that somebody blocks.
_get_handler, _set_handler, _SIGINT = _signal.getsignal, _signal.signal, int(SIGINT)


class InterruptGuard:
    """Turns the first SIGINT during a drive into a note that the scheduler reads between two events.

    A second SIGINT before the first was read is raised in place: the running callback does not come back. Until then a
    thread says what is waited for, because nothing else can. Outside the main thread Python delivers no signals, and
    the guard does nothing.

    ``wake`` lets the scheduler look; ``running`` names what it runs.
    """

    def __init__(self, wake: Callable[[], None], running: Callable[[], str]) -> None:
        self._wake = wake
        self._running = running
        self._told: threading.Timer | None = None
        self.noted = False
        """An interrupt came that nobody has taken yet."""
        self._depth = 0
        self._previous: Any = None

    def arm(self) -> None:
        """Catch SIGINT if this is the main thread and Python's handling is not switched off."""
        self._depth += 1
        if self._depth > 1 or threading.get_ident() != MAIN_THREAD:
            return
        if callable(_get_handler(_SIGINT)):
            self._previous = _set_handler(_SIGINT, self._handle)

    def disarm(self) -> None:
        """Give SIGINT back."""
        self._depth -= 1
        if self._depth == 0 and self._previous is not None:
            _set_handler(_SIGINT, self._previous)
            self._previous = None

    def take(self) -> bool:
        """Return whether an interrupt was noted, and forget it."""
        noted, self.noted = self.noted, False
        if self._told is not None:
            self._told.cancel()
            self._told = None
        return noted

    def _handle(self, _signum: int, frame: FrameType | None) -> None:
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        self._wake()
        place = users_place(frame)
        if place:
            self._told = threading.Timer(PATIENCE_S, self._tell, (place,))
            self._told.daemon = True
            self._told.start()

    def _tell(self, place: str) -> None:
        if self.noted:
            sys.stderr.write(
                f"Ctrl-C: waiting for {self._running()} to come back from {place}. Press Ctrl-C again to end it at "
                "once.\n"
            )


def users_place(frame: FrameType | None) -> str:
    """Return which function of the user's runs in ``frame``, the outermost one, and at which line.

    Empty for rosmini's own code.
    """
    found: FrameType | None = None
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if not module.startswith("rosmini."):
            found = frame
        elif found is not None and module.startswith("rosmini.core.graph."):
            break  # who called it
        frame = frame.f_back
    if frame is None or found is None:
        return ""
    code = found.f_code
    return f"{code.co_name} ({Path(code.co_filename).name}, line {found.f_lineno})"


T = TypeVar("T")

LOOK_S = 0.005
"""How often a run beside another thread's checks whether it is over."""


def on_hub(scheduler: Scheduler, function: Callable[[], T]) -> T:
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
    """Return a function that warns on standard error if nobody drives the graph that the calling thread waits for."""
    name = threading.current_thread().name

    def complain() -> None:
        if not scheduler.driven:
            sys.stderr.write(
                f"{name} waits for {waiter.reason}, but nobody drives the graph. "
                "Call graph.run(), or anything that blocks, in the thread that made the graph.\n"
            )

    return complain


def run_beside(scheduler: Scheduler, until_ns: int | None, until: Callable[[], bool] | None) -> RunReport:
    """Wait for the time or the condition while another thread drives, as ``run`` does in wall time."""
    waiter = Waiter(scheduler, "the end of the run")

    def look() -> None:
        if until is not None and until():
            waiter.wake("condition")
        elif until_ns is not None and scheduler.now_ns() >= until_ns:
            waiter.wake("time")
        elif not waiter.done:
            soon = scheduler.now_ns() + int(LOOK_S * 1e9 * scheduler.rate)
            scheduler.call_at(soon if until_ns is None else min(soon, until_ns), look)

    scheduler.call_soon_threadsafe(look)
    try:
        waiter.wait()
    finally:
        waiter.wake("stopped")
    return scheduler.report(waiter.value)


def in_thread(scheduler: Scheduler, function: Callable[[], T]) -> T:
    """Return ``function()``, run in a helper thread; the calling lane is parked and simulated time stands still."""
    waiter = Waiter(scheduler, "the operating system")
    scheduler.hold()

    def work() -> None:
        try:
            waiter.wake(function())
        except BaseException as error:
            waiter.fail(error)
        finally:
            scheduler.release()

    threading.Thread(target=work, name="rosmini-helper", daemon=True).start()
    waiter.wait()
    return cast("T", waiter.value)
