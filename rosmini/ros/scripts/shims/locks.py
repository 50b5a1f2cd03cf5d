"""Locks and events between lanes and real threads that never block the thread running the graph.

A lane that must wait is parked. The classes behave like those of ``threading``, whose other classes are based on
them; each script has its own subclasses (see :mod:`rosmini.ros.scripts.shims.threads`) with ``_script`` set.
"""

from __future__ import annotations

import _thread
import contextlib
from collections import deque
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from rosmini.core.graph.lanes import Waiter
    from rosmini.ros.scripts.context import ScriptContext


def to_ns(seconds: float | None) -> int | None:
    """Return a timeout in nanoseconds; None (for ever) stays None, a negative one becomes 0."""
    return None if seconds is None else max(round(seconds * 1e9), 0)


class ForScript:
    """Base class of objects that belong to one script."""

    _script: ClassVar[ScriptContext]


class Lock(ForScript):
    """A replacement for ``threading.Lock``."""

    _reason = "a lock"
    """What a waiting lane is waiting for, in reports."""

    def __init__(self) -> None:
        self._flag = _thread.allocate_lock()
        self._queue: deque[Waiter] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Acquire the lock, waiting unless ``blocking`` is false, up to ``timeout`` seconds."""
        if timeout != -1:
            if not blocking:
                raise ValueError("can't specify a timeout for a non-blocking call")
            if timeout < 0:
                raise ValueError("timeout value must be a non-negative number")
        if self._flag.acquire(blocking=False):
            return True
        return blocking and self._wait(None if timeout == -1 else to_ns(timeout))

    def _wait(self, timeout_ns: int | None) -> bool:
        script = self._script
        deadline = None if timeout_ns is None else script.scheduler.now_ns() + timeout_ns
        again = False
        while True:
            waiter = script.scheduler.waiter(self._reason)
            if again:
                self._queue.appendleft(waiter)  # who was first in the queue stays first
            else:
                self._queue.append(waiter)
            if self._flag.acquire(blocking=False):
                self._leave_queue(waiter, pass_on=False)
                return True
            try:
                left = None if deadline is None else max(deadline - script.scheduler.now_ns(), 0)
                woken = script.block(waiter, left)
            except BaseException:
                self._leave_queue(waiter, pass_on=True)
                raise
            if self._flag.acquire(blocking=False):
                self._leave_queue(waiter, pass_on=False)
                return True
            if not woken:
                self._leave_queue(waiter, pass_on=True)
                return False
            again = True

    def _leave_queue(self, waiter: Waiter, *, pass_on: bool) -> None:
        try:
            self._queue.remove(waiter)
        except ValueError:  # it was woken: wake another one if nobody acquires the lock now
            if pass_on and not self._flag.locked():
                self._wake_next()

    def _wake_next(self) -> None:
        with contextlib.suppress(IndexError):
            self._queue.popleft().wake()

    def release(self) -> None:
        """Release the lock; from any thread."""
        if not self._flag.locked():
            raise RuntimeError("release unlocked lock")
        self._flag.release()
        self._wake_next()

    def locked(self) -> bool:
        """Return True if it is held."""
        return self._flag.locked()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_exc: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        """Reset to unlocked; the standard library calls this in a forked child."""
        self.__init__()  # type: ignore[misc]

    def __repr__(self) -> str:
        return f"<{'locked' if self.locked() else 'unlocked'} {type(self).__name__}>"


class Event(ForScript):
    """A replacement for ``threading.Event``."""

    def __init__(self) -> None:
        self._set = False
        self._waiting: deque[Waiter] = deque()

    def is_set(self) -> bool:
        """Return True if it is set."""
        return self._set

    isSet = is_set

    def set(self) -> None:
        """Set it and wake all waiting lanes and threads."""
        self._set = True
        while self._waiting:
            try:
                self._waiting.popleft().wake()
            except IndexError:  # another thread was quicker
                break

    def clear(self) -> None:
        """Unset it."""
        self._set = False

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until it is set, up to ``timeout`` seconds; return True if it is set."""
        if self._set:
            return True
        waiter = self._script.scheduler.waiter("an event to be set")
        self._waiting.append(waiter)
        if self._set:
            waiter.wake()
        try:
            return self._script.block(waiter, to_ns(timeout)) or self._set
        finally:
            with contextlib.suppress(ValueError):
                self._waiting.remove(waiter)
