"""How real threads have something done by the scheduler's thread, and the other way round."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, TypeVar, cast

from greenlet import GreenletExit

from rosmini.errors import ROSInterruptException

from .lanes import Lane, LaneExit

if TYPE_CHECKING:
    from collections.abc import Callable

    from .scheduler import Scheduler

T = TypeVar("T")


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
