"""How real threads have something done by the scheduler's thread, and the other way round."""

from __future__ import annotations

import sys
import threading
from typing import TYPE_CHECKING, Protocol, TypeVar, cast

from greenlet import GreenletExit

from rosmini.core.errors import ROSInterruptException

from .lanes import Hub, Lane, LaneExit, Waiter

if TYPE_CHECKING:
    from collections.abc import Callable

    from .report import RunReport

T = TypeVar("T")

LOOK_S = 0.005
"""How often a run beside another thread's checks whether it is over."""


class Driven(Hub, Protocol):
    """What is needed of a scheduler that another thread drives."""

    @property
    def driven(self) -> bool:
        """True while somebody drives the queue."""

    def report(self, reason: str) -> RunReport:
        """Return how things stand at the end of a run."""

    def hold(self) -> None:
        """Let simulated time stand still until :meth:`release`."""

    def release(self) -> None:
        """Undo one :meth:`hold`."""


def on_hub(scheduler: Hub, function: Callable[[], T]) -> T:
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


def complaint(scheduler: Driven, waiter: Waiter) -> Callable[[], None]:
    """Return a function that warns on standard error if nobody drives the graph that the calling thread waits for."""
    name = threading.current_thread().name

    def complain() -> None:
        if not scheduler.driven:
            sys.stderr.write(
                f"{name} waits for {waiter.reason}, but nobody drives the graph. "
                "Call graph.run(), or anything that blocks, in the thread that made the graph.\n"
            )

    return complain


def run_beside(scheduler: Driven, until_ns: int | None, until: Callable[[], bool] | None) -> RunReport:
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


def in_thread(scheduler: Driven, function: Callable[[], T]) -> T:
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
