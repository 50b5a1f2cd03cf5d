"""Calls of planners and recovery behaviours from other packages, which may raise, block forever, or never return.

Plugins of rosmini are called directly. Others run in a separate lane with a budget: blocking is limited in seconds of
the graph's time, and computing by the number of loop iterations, of which 1,000 count as a millisecond, as they do in
scripts. Wall-clock time has no effect, so the result is the same on every machine.
"""

from __future__ import annotations

import sys
import sysconfig
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException
from rosmini.navigation.nav_core import NavigationFailure

if TYPE_CHECKING:
    from rosmini.core.graph import Node

ITERATIONS_PER_SECOND = 1_000_000
"""Number of loop iterations that count as one second."""

_ROSMINI = str(Path(__file__).resolve().parents[2])
_OURS = (_ROSMINI, *{sysconfig.get_path(kind) for kind in ("stdlib", "purelib", "platlib")}, "<frozen")


class PluginFault(NavigationFailure):
    """Raised if a plugin exceeds its budget, or raises neither `NavigationFailure` nor `ROSInterruptException`."""


def call(node: Node, what: str, function: Callable[..., Any], *arguments: Any, budget: float) -> Any:
    """Return the result of a plugin's method, `function`; `what` names it in error messages.

    `budget` [s] limits the call, unless the plugin is one of rosmini's. Exceptions of the types `NavigationFailure` and
    `ROSInterruptException` are passed on; any other exception, or exceeding the budget, raises `PluginFault`.
    """
    owner = getattr(function, "__self__", function)
    is_ours = type(owner).__module__.startswith("rosmini.")
    try:
        if is_ours:
            return function(*arguments)
        return _run_in_lane(node, what, partial(function, *arguments), budget)
    except (NavigationFailure, ROSInterruptException):
        raise
    except Exception as error:
        raise PluginFault(f"{what} raised {type(error).__name__}: {error} ({_location(error)})") from error


def _location(error: Exception) -> str:
    """Return file and line of the innermost frame outside rosmini, Python and installed packages, if there is one."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if not frame.filename.startswith(_OURS)] or list(frames)
    return f"{Path(own[-1].filename).name}, line {own[-1].lineno}" if own else "nowhere"


def _run_in_lane(node: Node, what: str, task: Callable[[], Any], budget: float) -> Any:
    waiter = node.waiter(f"{what} to return")

    def run() -> None:
        watch = LoopWatch(what, int(budget * ITERATIONS_PER_SECOND))
        watch.start()
        outcome: tuple[Any, Exception | None]
        try:
            outcome = (task(), None)
        except Exception as error:
            outcome = (None, error)
        finally:
            watch.stop()
        waiter.wake(outcome)

    lane = node.spawn(f"{node.name} {what}", run)
    if not node.wait(waiter, budget):
        why = lane.waiting_for
        lane.kill()
        raise PluginFault(
            f"{what} did not return within {budget:g} s{f', waiting for {why}' if why else ''}, and was stopped"
        )
    result, error = waiter.value
    if error is not None:
        raise error
    return result


class LoopWatch:
    """Counts loop iterations outside rosmini and installed packages, and raises `PluginFault` after `limit` of them.

    It uses Python's trace function, so it does nothing while a debugger or a coverage tool is using that, nor on
    Emscripten: Pyodide crashes where a traced stack is suspended.
    """

    def __init__(self, what: str, limit: int) -> None:
        self.what, self.limit, self.iterations = what, limit, 0
        self._foreign: dict[str, bool] = {}

    def start(self) -> None:
        """Start counting in this thread, unless it is already being traced."""
        if sys.platform != "emscripten" and sys.gettrace() is None:
            sys.settrace(self)

    def stop(self) -> None:
        """Stop counting."""
        if isinstance(sys.gettrace(), LoopWatch):
            sys.settrace(None)

    def __call__(self, frame: FrameType, event: str, _: Any) -> Callable[..., Any] | None:
        """Return the trace function of a new frame, as `sys.settrace` requires; None for frames that do not count."""
        file = frame.f_code.co_filename
        foreign = self._foreign.get(file)
        if foreign is None:
            foreign = self._foreign[file] = not file.startswith(_OURS)
        if not foreign or event != "call":
            return None
        return self._trace_lines(frame.f_lineno)

    def _trace_lines(self, line: int) -> Callable[..., Any]:
        last = line

        def trace(frame: FrameType, event: str, _: Any) -> Callable[..., Any]:
            nonlocal last
            if event == "line":
                if frame.f_lineno <= last:
                    self._count_iteration(frame)
                last = frame.f_lineno
            return trace

        return trace

    def _count_iteration(self, frame: FrameType) -> None:
        self.iterations += 1
        if self.iterations > self.limit:
            raise PluginFault(
                f"{self.what} has not returned after {self.limit:,} loop iterations: check that the loop in "
                f"line {frame.f_lineno} of {Path(frame.f_code.co_filename).name} ends"
            )
