"""Calls of planners and recovery behaviours from other packages, which may raise or block forever.

Plugins of rosmini are called directly. Others run in a separate lane with a budget in seconds of the graph's time.
Wall-clock time has no effect, so the result is the same on every machine.
"""

from __future__ import annotations

import sysconfig
import traceback
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSInterruptException
from rosmini.navigation.nav_core import NavigationFailure

if TYPE_CHECKING:
    from rosmini.core.graph import Node

_ROSMINI = str(Path(__file__).resolve().parents[2])
_OURS = (_ROSMINI, *{sysconfig.get_path(kind) for kind in ("stdlib", "purelib", "platlib")}, "<frozen")


class PluginFault(NavigationFailure):
    """Raised if a plugin raises an exception other than `NavigationFailure`, or exceeds its budget."""


def call(node: Node, what: str, function: Callable[..., Any], *arguments: Any, budget: float) -> Any:
    """Call a plugin's method; `what` names it in error messages, and `budget` is in seconds.

    Raises the method's exception if that is a `NavigationFailure`, and `PluginFault` for all others.
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
    """Return file and line of the innermost frame outside rosmini, Python and installed packages."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if not frame.filename.startswith(_OURS)] or list(frames)
    return f"{Path(own[-1].filename).name}, line {own[-1].lineno}" if own else "nowhere"


def _run_in_lane(node: Node, what: str, task: Callable[[], Any], budget: float) -> Any:
    waiter = node.waiter(f"{what} to return")

    def run() -> None:
        outcome: tuple[Any, Exception | None]
        try:
            outcome = (task(), None)
        except Exception as error:
            outcome = (None, error)
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
