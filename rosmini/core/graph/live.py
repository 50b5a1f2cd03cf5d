"""A graph that the event loop of a Jupyter kernel drives, in small slices.

Between two slices the kernel serves widgets and runs cells; a cell that blocks drives the graph itself meanwhile.
Everything runs in the kernel's main thread: calls from other threads (JupyterLab handles widgets in one) come through
the inbox.
"""

from __future__ import annotations

import re
import signal
import sys
import time
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException, RosminiError

from .notebook import kernel_loop, kernel_shell, turn
from .report import ended

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

    from .graph import Graph
    from .lanes import Waiter

SLICE_S = 0.01
"""Interval between slices [s]: half that between the frames of a view at 50 frames per second."""

BUDGET_S = 0.02
"""Maximum length of a slice [s]; a single callback that takes longer is not interrupted."""

LAG_S = 0.5
"""Maximum delay [s] that a live graph catches up on, such as the time to draw a large scene.

After a longer delay it continues without catching up on the rest.
"""

SLEEP = re.compile(r"\btime\s*\.\s*sleep\s*\(")
"""Matches a call in the text of a cell that would block the kernel."""

STOPPED = (
    "The live graph was stopped. Call live() to go on; with Graph(strict=False) such errors are logged instead, "
    "as in ROS."
)


class LoopDrive(ABC):
    """Drives ``graph`` in slices in ``loop`` until :meth:`stop`, or until :meth:`is_finished` returns True."""

    def __init__(self, graph: Graph, loop: asyncio.AbstractEventLoop) -> None:
        self.graph = graph
        self.running = True
        self._loop = loop
        self._noted = False
        self._kernel = kernel_shell()
        self._turn = turn()
        loop.call_soon_threadsafe(self._step)

    def stop(self) -> None:
        """Stop driving the graph. Safe in any thread, and safe to call again."""
        if self.running:
            self.running = False
            self._loop.call_soon_threadsafe(self._let_go)

    def is_finished(self) -> bool:
        """Return True if there is no reason to drive any longer."""
        return not self.running

    def _step(self) -> None:
        if self.is_finished():
            self.stop()
            return
        self._catch_interrupts()
        delay = SLICE_S
        try:
            if self._noted:
                raise KeyboardInterrupt  # as an interrupt during a slice would
            if not (self.graph.scheduler.driven or self._turn.is_taken):
                with self._turn:
                    delay = self._slice()
        except BaseException as error:  # there is no call at which to raise it
            self.stop()
            self._failed(error)
        if self.running:
            self._loop.call_later(delay, self._step)

    @abstractmethod
    def _slice(self) -> float:
        """Drive for a moment; return the delay before the next slice [s]."""

    @abstractmethod
    def _failed(self, error: BaseException) -> None:
        """Report why the drive ended."""

    def _drive(self, until_ns: int | None = None, until: Callable[[], bool] | None = None) -> str:
        """Run until the given time or condition, but not longer than the budget; return why the run ended."""
        deadline = time.perf_counter() + BUDGET_S
        scheduler = self.graph.scheduler
        if not scheduler.simulated:
            until_ns, until = scheduler.now_ns() + int(BUDGET_S * scheduler.rate * 1e9), scheduler.is_idle
        return scheduler.run(until_ns, lambda: time.perf_counter() > deadline or (until is not None and until())).reason

    # Between cells ipykernel ignores interrupts, so they are meant for the live graph.

    def _catch_interrupts(self) -> None:
        if self._kernel is None:
            return
        handler = signal.getsignal(signal.SIGINT)
        owner = getattr(handler, "__self__", None)
        # The kernel may have restored the handler of a drive that has ended.
        if handler is signal.SIG_IGN or (isinstance(owner, LoopDrive) and not owner.running):
            signal.signal(signal.SIGINT, self._interrupted)

    def _interrupted(self, _signum: int, _frame: Any) -> None:
        self._noted = True

    def _let_go(self) -> None:
        if signal.getsignal(signal.SIGINT) == self._interrupted:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


class LiveDrive(LoopDrive):
    """Drives ``graph`` at ``rate`` seconds of graph time per second until :meth:`stop`; made by :meth:`Graph.live`.

    A graph in simulated time follows the wall clock at this rate; one in wall-clock time keeps its own rate. The output
    of callbacks appears in the cell that drives, or else in the one that called ``live``. An error that would end a
    ``graph.run()`` is shown there and stops the drive, as does an interrupt while no cell runs.
    """

    def __init__(self, graph: Graph, loop: asyncio.AbstractEventLoop, *, rate: float = 1.0) -> None:
        if not rate > 0:
            msg = f"the rate of a live graph must be positive, not {rate!r}"
            raise RosminiError(msg)
        self.rate = rate
        self._graph_start = graph.scheduler.now_ns()
        self._start = time.perf_counter()
        super().__init__(graph, loop)
        if self._kernel is not None:
            self._kernel.events.register("pre_run_cell", self._warn_of_sleep)

    def __repr__(self) -> str:
        return f"<live graph, {self.rate:g} s a second{'' if self.running else ', stopped'}>"

    def _let_go(self) -> None:
        super()._let_go()
        if self._kernel is not None:
            self._kernel.events.unregister("pre_run_cell", self._warn_of_sleep)

    def _warn_of_sleep(self, info: Any) -> None:
        """Warn, before a cell that calls ``time.sleep`` runs, that the graph is paused meanwhile."""
        if self.running and SLEEP.search(info.raw_cell or ""):
            sys.stderr.write(
                "time.sleep() keeps the kernel busy, so the live graph stands still meanwhile. "
                "Let graph.run(seconds) or a node's sleep(seconds) wait instead: with them it goes on.\n"
            )

    def _slice(self) -> float:
        if not self.graph.simulated:
            self._drive()
            return SLICE_S
        target = self._target()
        self._drive(target)
        is_late = self.running and self.graph.scheduler.now_ns() < target
        return 0.0 if is_late else SLICE_S

    def _target(self) -> int:
        now, wall = self.graph.scheduler.now_ns(), time.perf_counter()
        target = self._graph_start + int((wall - self._start) * self.rate * 1e9)
        latest = now + int(LAG_S * self.rate * 1e9)
        if now <= target <= latest:
            return target
        # A cell drove the graph ahead, or kept the kernel busy: continue from here.
        self._graph_start, self._start = max(now, min(target, latest)), wall
        return self._graph_start

    def _failed(self, error: BaseException) -> None:
        if isinstance(error, KeyboardInterrupt):
            sys.stderr.write("The live graph was stopped by an interrupt. Call live() to go on.\n")
            return
        error.add_note(STOPPED)
        if self._kernel is None:
            self._loop.call_exception_handler({"message": "a live graph met an error", "exception": error})
        else:
            self._kernel.showtraceback((type(error), error, error.__traceback__))


class DriveForBlockedCall(LoopDrive):
    """Drives ``graph`` in the kernel's main thread for a call blocked in another thread, unless already driven."""

    def __init__(self, graph: Graph, waiter: Waiter) -> None:
        self._waiter = waiter
        self._begun = False
        if not graph.scheduler.is_in_main_thread():
            msg = (
                "this graph was made in another thread (in a widget's callback?), which is not there to run it. "
                "Make the graph in a cell."
            )
            raise RosminiError(msg)
        super().__init__(graph, kernel_loop())

    def is_finished(self) -> bool:
        """Return True if the other thread's call has ended."""
        return self._waiter.settled

    def complain(self) -> None:
        """Warn if a running cell keeps the graph from being driven. Called in the other thread."""
        if not self._begun and not self.graph.scheduler.driven:
            sys.stderr.write(
                "A call in another thread is waiting, and the graph is paused because the running cell does not drive "
                "it. It continues after that cell; interrupt the cell, or let it block with node.sleep() or "
                "graph.run().\n"
            )

    def _slice(self) -> float:
        self._begun = True
        if self.graph.is_live:
            return SLICE_S
        if self._drive(until=self.is_finished) == "drained" and not self.is_finished():
            self._waiter.fail(ended(self._waiter.reason, self.graph.scheduler.waiting()))
        return 0 if self.graph.simulated else SLICE_S

    def _failed(self, error: BaseException) -> None:
        if isinstance(error, KeyboardInterrupt):
            error = ROSInterruptException("interrupted")
        self._waiter.fail(error)
