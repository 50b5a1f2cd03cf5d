"""Handles: a common way to start, await and end scripts, built-in nodes and processes.

A handle is used like a ``subprocess.Popen``; its times are graph time. Waiting parks a lane, or drives the graph in
the main program or a notebook cell.
"""

from __future__ import annotations

import signal
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import RosminiError, ScriptError
from rosmini.core.graph.event_queue import span_ns
from rosmini.core.graph.lanes import Lane

from .context import current_script

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Graph
    from rosmini.core.graph.lanes import Waiter

    from .console import Console

SIGINT_TIMEOUT_S = 15.0
"""Time between SIGINT and SIGTERM in roslaunch [s] (http://wiki.ros.org/roslaunch/Commandline%20Tools)."""

SIGTERM_TIMEOUT_S = 2.0
"""Time between SIGTERM and SIGKILL in roslaunch [s]."""

KILLED = -9
"""Return code after ``kill`` (SIGKILL, which has no name on Windows)."""


class StillRunning(ScriptError, TimeoutError):
    """``wait(timeout)`` has timed out."""


def shell_status(returncode: int) -> int:
    """Return the exit status that a shell shows for a return code: 128 + N after signal N."""
    return returncode if returncode >= 0 else 128 - returncode


class LaneHandle(ABC):
    """Base class of the handles of scripts and built-in nodes, which run in lanes of ``graph``.

    ``console`` creates its console; with ``owns_console`` it is used by nothing else, and closed at the end.
    """

    def __init__(
        self, graph: Graph, args: tuple[str, ...], console: Callable[[], Console], *, owns_console: bool = True
    ) -> None:
        self.graph = graph
        self.scheduler = graph.scheduler
        self.args = args
        self.returncode: int | None = None
        self.on_end: Callable[[int], object] | None = None
        """Called with the return code at each end; may start it again."""
        self.on_start: Callable[[], object] | None = None
        """Called at each start."""
        self._make_console = console
        self._owns_console = owns_console
        self._console: Console | None = None
        self._running = False
        self._waiters: dict[Waiter, None] = {}
        self._next_step: Any = None
        """Timer of the next action: a further signal, or the next start."""

    @property
    @abstractmethod
    def name(self) -> str:
        """Name in output and messages."""

    def __repr__(self) -> str:
        state = "running" if self._running else "not running" if self.returncode is None else self._ended_how()
        return f"<{type(self).__name__} {self.name}: {state}>"

    def _ended_how(self) -> str:
        return f"ended with exit status {self.returncode}"

    def instance(self) -> Any:
        """Return the object that a built-in node created. Raises ``ScriptError`` for a script, which has none."""
        raise ScriptError(f"{self.name} is a script, which has no such object; wait() returns its exit status")

    @property
    def output(self) -> str | None:
        """Captured output so far, or None."""
        return None if self._console is None else self._console.captured

    @property
    def console(self) -> Console:
        """Console for input and output, created at the start."""
        if self._console is None:
            self._console = self._make_console()
        return self._console

    # -- its life ------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start it, or restart it after its end. Raises ``ScriptError`` while it runs."""
        self._refuse_while_running()
        self._cancel_step()
        if self._owns_console:
            self._console = None
        self.returncode = None
        self._running = True
        try:
            self._launch()
        except BaseException:
            self._running = False
            raise
        if self.on_start is not None:
            self.on_start()

    def respawn(self, delay: float = 0.0) -> None:
        """Restart it with the same arguments after ``delay`` seconds of graph time; `terminate` and `kill` cancel that.

        Raises ``ScriptError`` while it runs.
        """
        self._refuse_while_running()
        self._cancel_step()
        self.returncode = None
        self._later(span_ns(delay, "the delay of a respawn"), self._restart)

    def _restart(self) -> None:
        self.returncode = None
        try:
            self.start()
        except RosminiError as error:  # the script's file has gone, for instance
            self.console.report(self.name, error)
            self._conclude(1)

    def poll(self) -> int | None:
        """Return ``returncode``."""
        return self.returncode

    def wait(self, timeout: float | None = None) -> int:
        """Wait until it ends, up to ``timeout`` seconds of graph time; return ``returncode``.

        Raises ``StillRunning`` after the timeout, ``GraphEnded`` if no event is left that could end it, and
        ``ScriptError`` if it was never started.
        """
        if self.returncode is None and not self._running and self._next_step is None:
            raise ScriptError(f"{self.name} was not started; call start() first")
        if self.returncode is not None:
            return self.returncode
        timeout_ns = None if timeout is None else span_ns(timeout, "the time-out of a wait")
        waiter = self.scheduler.waiter(f"{self.name} to end")
        self._waiters[waiter] = None
        script = current_script(self.scheduler)
        try:
            woken = waiter.wait(timeout_ns) if script is None else script.block(waiter, timeout_ns)
        finally:
            self._waiters.pop(waiter, None)
        if not woken:
            raise StillRunning(f"{self.name} has not ended within {timeout:g} s")
        returncode: int = waiter.value
        return returncode

    def send_signal(self, signum: int) -> None:
        """Send it a signal: a script's handler is called, rospy and built-in nodes shut down, otherwise it ends."""
        if self._running:
            self._signal(signal.Signals(signum))

    def terminate(self, sigint_timeout: float = SIGINT_TIMEOUT_S, sigterm_timeout: float = SIGTERM_TIMEOUT_S) -> None:
        """End it as roslaunch does, without waiting: SIGINT, after a timeout SIGTERM, after another one ``kill``.

        Timeouts are in seconds of graph time. May be called repeatedly and after the end.
        """
        if not self._running:
            self._call_off()
        elif self._next_step is None:
            first = span_ns(sigint_timeout, "the time-out after SIGINT")
            second = span_ns(sigterm_timeout, "the time-out after SIGTERM")
            self._later(first, lambda: self._harder(second))
            self.send_signal(signal.SIGINT)

    def _harder(self, timeout_ns: int) -> None:
        self._later(timeout_ns, self.kill)
        self.send_signal(signal.SIGTERM)

    def kill(self) -> None:
        """Kill it without handlers, shutdown hooks or ``atexit``; its node is unregistered."""
        if self._running:
            self.end_now(KILLED)
        else:
            self._call_off()

    @abstractmethod
    def end_now(self, returncode: int) -> None:
        """Kill it, with this return code."""

    @abstractmethod
    def _launch(self) -> None: ...

    @abstractmethod
    def _signal(self, signum: signal.Signals) -> None: ...

    # -- for subclasses ------------------------------------------------------------------------------------------

    def _refuse_while_running(self) -> None:
        if self._running:
            raise ScriptError(f"{self.name} runs already; wait for its end, or terminate() it first")

    def _later(self, delay_ns: int, step: Callable[[], object]) -> None:
        def due() -> None:
            self._next_step = None
            Lane(self.scheduler, f"{self.name} handle").submit(step)  # it may ask the Master, which takes time

        self._next_step = self.scheduler.call_at(self.scheduler.now_ns() + delay_ns, due)

    def _cancel_step(self) -> None:
        if self._next_step is not None:
            self._next_step.cancel()
            self._next_step = None

    def _call_off(self) -> None:
        """Cancel a pending respawn."""
        if self._next_step is not None:
            self._cancel_step()
            self._conclude(KILLED)

    def _conclude(self, returncode: int) -> None:
        """Record the end, and wake those who wait for it."""
        self._running = False
        self.returncode = returncode
        self._cancel_step()
        if self._console is not None:
            if self._owns_console:
                self._console.close()
            else:
                self._console.flush()
        for waiter in list(self._waiters):
            waiter.wake(returncode)
        if self.on_end is not None:
            self.on_end(returncode)
