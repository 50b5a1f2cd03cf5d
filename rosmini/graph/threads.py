"""How real threads have something done by the scheduler's thread, and the other way round."""

from __future__ import annotations

import sys
import threading
from typing import TYPE_CHECKING, TypeVar, cast

from greenlet import GreenletExit

from rosmini.errors import ROSInterruptException

from .lanes import Lane, LaneExit

if TYPE_CHECKING:
    from collections.abc import Callable

    from .lanes import Waiter
    from .report import RunReport
    from .scheduler import Scheduler

T = TypeVar("T")

LOOK_S = 0.005
"""How often a run beside another thread's looks whether it is over."""


def on_hub(scheduler: Scheduler, function: Callable[[], T]) -> T:
    """Return ``function()``, run in the hub's thread, in a lane with the caller's node and context; blocks."""
    waiter = scheduler.waiter("the thread that runs the graph")
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
    """Return what says on standard error that the calling thread waits for somebody to drive the graph, if nobody does."""
    name = threading.current_thread().name

    def complain() -> None:
        if not scheduler.driven:
            sys.stderr.write(
                f"{name} waits for {waiter.reason}, and the graph stands still: nobody drives it. "
                "Call graph.run(), or anything that blocks, in the thread that made the graph.\n"
            )

    return complain


def run_beside(scheduler: Scheduler, until_ns: int | None, until: Callable[[], bool] | None) -> RunReport:
    """Do what ``run`` does in wall time while another thread drives: wait for the time or the condition."""
    waiter = scheduler.waiter("the end of the run")

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
    """Return ``function()``, run in a helper thread while the calling lane is parked and simulated time stands still."""
    waiter = scheduler.waiter("the operating system")
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
