"""A graph that goes on by itself in Jupyter: driven in small slices from the kernel's own event loop.

Between two slices the kernel answers widgets and runs cells; a cell that blocks drives the graph itself meanwhile.
"""

from __future__ import annotations

import asyncio
import sys
import time
from typing import TYPE_CHECKING

from rosmini.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Callable

    from .graph import Graph

SLICE_S = 0.01
"""How often the graph gets its turn: twice as often as a view is drawn at 50 frames a second."""


def kernel_loop() -> asyncio.AbstractEventLoop:
    """Return the event loop of the main thread's Jupyter kernel, or the running one. Raises ``RosminiError`` without one."""
    if "IPython" in sys.modules:
        shell = sys.modules["IPython"].get_ipython()
        kernel = getattr(shell, "kernel", None)
        loop = getattr(getattr(kernel, "io_loop", None), "asyncio_loop", None)
        if isinstance(loop, asyncio.AbstractEventLoop):
            return loop
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        msg = "a live graph needs an event loop, as a notebook has; in a program call graph.run() instead"
        raise RosminiError(msg) from None


class LiveDrive:
    """Drives ``graph`` from ``loop`` at ``rate`` seconds of graph time a second until :meth:`stop`.

    A graph in simulated time is let go on to where wall time has got to; one in wall time keeps its own rate.
    """

    def __init__(
        self,
        graph: Graph,
        loop: asyncio.AbstractEventLoop,
        *,
        rate: float = 1.0,
        on_error: Callable[[BaseException], None] | None = None,
    ) -> None:
        if not rate > 0:
            msg = f"the rate of a live graph must be positive, not {rate!r}"
            raise RosminiError(msg)
        self.graph = graph
        self.rate = rate
        self._loop = loop
        self._on_error = on_error
        self._handle: asyncio.TimerHandle | asyncio.Handle | None = None
        self._graph_start = graph.scheduler.now_ns()
        self._start = time.monotonic()
        self.running = True
        loop.call_soon_threadsafe(self._step)

    def __repr__(self) -> str:
        return f"<live graph, {self.rate:g} s a second{'' if self.running else ', stopped'}>"

    def stop(self) -> None:
        """Let the graph stand still again. From any thread; harmless when repeated."""
        self.running = False
        handle, self._handle = self._handle, None
        if handle is not None:
            self._loop.call_soon_threadsafe(handle.cancel)

    def _step(self) -> None:
        if not self.running:
            return
        scheduler = self.graph.scheduler
        try:
            if not scheduler.driven:
                scheduler.run(until_ns=self._target())
        except BaseException as error:
            self._failed(error)
        if self.running:
            self._handle = self._loop.call_later(SLICE_S, self._step)

    def _target(self) -> int:
        scheduler = self.graph.scheduler
        if not scheduler.simulated:
            return scheduler.now_ns()
        target = self._graph_start + int((time.monotonic() - self._start) * self.rate * 1e9)
        now = scheduler.now_ns()
        if now > target:  # a cell drove the graph ahead: go on from there
            self._graph_start, self._start = now, time.monotonic()
            return now
        return target

    def _failed(self, error: BaseException) -> None:
        if isinstance(error, KeyboardInterrupt):
            self.stop()
        if self._on_error is not None:
            self._on_error(error)
        else:
            self._loop.call_exception_handler({"message": "a live graph met an error", "exception": error})
