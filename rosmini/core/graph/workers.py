"""The greenlets that run a scheduler's loop, and how code finds the scheduler that runs it."""

from __future__ import annotations

import operator
import threading
from typing import TYPE_CHECKING, Any

from greenlet import getcurrent, greenlet

if TYPE_CHECKING:
    import weakref


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
