"""Greenlets for Emscripten: the part of greenlet's interface that the scheduler uses, on JavaScript promises.

WebAssembly code cannot switch stacks, but it may wait for a promise while other calls run (JavaScript Promise
Integration). Each greenlet therefore runs in a JavaScript call of its own; a switch resolves the promise that the
target waits for. There is one difference: a suspended greenlet without references is not ended, so its ``finally``
clauses do not run.
"""

from __future__ import annotations

import time
from contextvars import Context
from functools import wraps
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from js import Promise
from pyodide.code import run_js
from pyodide.ffi import can_run_sync, run_sync

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")

YIELD_PERIOD_S = 0.05
"""Interval at which the page receives its events while Python computes [s]."""

_call_later = run_js("async (function_) => { await null; await function_.callPromising(); }")
"""Calls a Python function on a new stack, as soon as the running one is suspended."""

_wait = run_js("(promise, ms) => Promise.race([promise, new Promise((end) => setTimeout(end, ms))])")
"""Returns a promise that is resolved with another one, or after this time."""

_never = Promise.withResolvers().promise


class GreenletExit(BaseException):
    """Ends the greenlet into which it is thrown. The parent receives it as the result."""


class greenlet:  # noqa: N801 - greenlet's own name
    """A stack for ``run``, which starts at the first :meth:`switch`."""

    current: ClassVar[Any] = None
    """The greenlet that is running."""

    def __init__(self, run: Callable[..., Any] | None = None) -> None:
        self.parent = greenlet.current
        """The greenlet that continues when this one ends, with its result or its error."""
        self._run = run
        self._waits_for: Any = None
        self._value: Any = None
        self._error: BaseException | None = None

    def switch(self, *values: Any) -> Any:
        """Suspend the caller and continue this greenlet. Return the values of the switch that continues the caller.

        Several values are returned as a tuple. Raises ``RosminiError`` if the caller cannot be suspended.
        """
        return greenlet.current.suspend(lambda: self.resume(values))

    def throw(self) -> Any:
        """Raise :class:`GreenletExit` in this greenlet, which must have started; otherwise like :meth:`switch`."""
        return greenlet.current.suspend(lambda: self.resume((), GreenletExit()))

    def suspend(self, resume_other: Callable[[], None]) -> Any:
        """Suspend this greenlet, which is running, after calling ``resume_other``."""
        if not can_run_sync():
            msg = "this browser cannot suspend Python, or Python was called in a way that does not allow it"
            raise RosminiError(msg)
        self._waits_for = Promise.withResolvers()
        resume_other()
        run_sync(self._waits_for.promise)
        greenlet.current = self
        value, error = self._value, self._error
        self._value = self._error = None
        if error is not None:
            raise error
        return value

    def resume(self, values: tuple[Any, ...], error: BaseException | None = None) -> None:
        """Let this greenlet continue as soon as the running one is suspended."""
        if self._run is not None:
            run, self._run = self._run, None
            _call_later(lambda: Context().run(self._body, run, values))
            return
        self._value = values[0] if len(values) == 1 else values
        self._error = error
        self._waits_for.resolve()

    def _body(self, run: Callable[..., Any], values: tuple[Any, ...]) -> None:
        greenlet.current = self
        try:
            result = run(*values)
        except GreenletExit as exit_:
            self.parent.resume((exit_,))
        except BaseException as error:
            self.parent.resume((), error)
        else:
            self.parent.resume((result,))


greenlet.current = greenlet()  # the stack of the page's own calls


def getcurrent() -> Any:
    """Return the greenlet that is running."""
    return greenlet.current


class held_lock:  # noqa: N801 - a function elsewhere
    """Return a lock that is held. While its owner waits for its release, the page receives its events."""

    def __init__(self) -> None:
        self._free = Promise.withResolvers()

    def acquire(self, *, timeout: float) -> None:
        """Wait until the lock is released, for at most ``timeout`` seconds."""
        run_sync(_wait(self._free.promise, 1000 * timeout))
        self._free = Promise.withResolvers()

    def release(self) -> None:
        """Release the lock. Harmless when repeated."""
        self._free.resolve()


def yielding(poll: Callable[[T], bool]) -> Callable[[T], bool]:
    """Return ``poll`` changed such that the page receives its events during some of the calls."""
    yield_at = 0.0

    @wraps(poll)
    def yield_and_poll(what: T) -> bool:
        nonlocal yield_at
        if time.perf_counter() >= yield_at and can_run_sync():
            run_sync(_wait(_never, 0))
            yield_at = time.perf_counter() + YIELD_PERIOD_S
        return poll(what)

    return yield_and_poll
