"""Locks between lanes and real threads, none of which ever blocks the thread that runs the graph.

A lane that must wait is parked. The classes behave as those of ``threading``; each script has its own subclasses (see
:mod:`rosmini.scripts.shims.threads`), in which ``_script`` is set.
"""

from __future__ import annotations

import _thread
import contextlib
from collections import deque
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph.lanes import Waiter
    from rosmini.scripts.script import Script


def to_ns(seconds: float | None) -> int | None:
    """Return a timeout in nanoseconds; None stays "for ever", less than nothing is nothing."""
    return None if seconds is None else max(round(seconds * 1e9), 0)


class ForScript:
    """Something that belongs to one script."""

    _script: ClassVar[Script]


class Lock(ForScript):
    """``threading.Lock``."""

    def __init__(self) -> None:
        self._flag = _thread.allocate_lock()
        self._queue: deque[Waiter] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Take the lock; wait for it unless ``blocking`` is false, for at most ``timeout`` seconds."""
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
            waiter = script.scheduler.waiter("a lock")
            if again:
                self._queue.appendleft(waiter)  # who was first in the queue stays first
            else:
                self._queue.append(waiter)
            if self._flag.acquire(blocking=False):
                self._give_up(waiter, pass_on=False)
                return True
            try:
                left = None if deadline is None else max(deadline - script.scheduler.now_ns(), 0)
                woken = script.block(waiter, left)
            except BaseException:
                self._give_up(waiter, pass_on=True)
                raise
            if self._flag.acquire(blocking=False):
                self._give_up(waiter, pass_on=False)
                return True
            if not woken:
                self._give_up(waiter, pass_on=True)
                return False
            again = True

    def _give_up(self, waiter: Waiter, *, pass_on: bool) -> None:
        try:
            self._queue.remove(waiter)
        except ValueError:  # it was woken: somebody else should be, if nobody takes the lock now
            if pass_on and not self._flag.locked():
                self._wake_next()

    def _wake_next(self) -> None:
        with contextlib.suppress(IndexError):
            self._queue.popleft().wake()

    def release(self) -> None:
        """Give the lock back; from any thread."""
        if not self._flag.locked():
            raise RuntimeError("release unlocked lock")
        self._flag.release()
        self._wake_next()

    def locked(self) -> bool:
        """Tell whether somebody has it."""
        return self._flag.locked()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_exc: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        """Be free again: what the standard library asks for in a forked child."""
        self.__init__()  # type: ignore[misc]

    def __repr__(self) -> str:
        return f"<{'locked' if self.locked() else 'unlocked'} {type(self).__name__}>"


class RLock(ForScript):
    """``threading.RLock``: its owner may take it again."""

    _lock_class: ClassVar[type[Lock]]

    def __init__(self) -> None:
        self._block = self._lock_class()
        self._owner: object = None
        self._count = 0

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        """Take the lock once more, or wait for it as ``Lock`` does."""
        me = self._script.scheduler.current()
        if self._owner is me:
            self._count += 1
            return True
        if not self._block.acquire(blocking, timeout):
            return False
        self._owner, self._count = me, 1
        return True

    def release(self) -> None:
        """Undo one ``acquire``."""
        if not self._is_owned():
            raise RuntimeError("cannot release un-acquired lock")
        self._count -= 1
        if not self._count:
            self._owner = None
            self._block.release()

    def locked(self) -> bool:
        """Tell whether somebody has it."""
        return self._block.locked()

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_exc: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        """Be free again: what the standard library asks for in a forked child."""
        self.__init__()  # type: ignore[misc]

    # The three that a Condition uses.

    def _is_owned(self) -> bool:
        return self._owner is self._script.scheduler.current()

    def _release_save(self) -> tuple[int, object]:
        state = (self._count, self._owner)
        self._owner, self._count = None, 0
        self._block.release()
        return state

    def _acquire_restore(self, state: tuple[int, object]) -> None:
        self._block.acquire()
        self._count, self._owner = state


class Condition(ForScript):
    """``threading.Condition``."""

    _lock_class: ClassVar[type[RLock]]

    def __init__(self, lock: Any = None) -> None:
        self._lock = self._lock_class() if lock is None else lock
        self.acquire: Callable[..., bool] = self._lock.acquire
        self.release: Callable[[], None] = self._lock.release
        self._waiting: deque[Waiter] = deque()

    def __enter__(self) -> bool:
        return bool(self._lock.__enter__())

    def __exit__(self, *exc: object) -> None:
        self._lock.__exit__(*exc)

    def _is_owned(self) -> bool:
        own = getattr(self._lock, "_is_owned", None)
        if own is not None:
            return bool(own())
        if self._lock.acquire(False):
            self._lock.release()
            return False
        return True

    def wait(self, timeout: float | None = None) -> bool:
        """Give the lock back, wait for a notification for at most ``timeout`` seconds, take it again."""
        if not self._is_owned():
            raise RuntimeError("cannot wait on un-acquired lock")
        waiter = self._script.scheduler.waiter("a condition")
        self._waiting.append(waiter)
        state = self._let_go()
        try:
            return self._script.block(waiter, to_ns(timeout))
        finally:
            with contextlib.suppress(ValueError):  # it was notified
                self._waiting.remove(waiter)
            self._take_back(state)

    def _let_go(self) -> Any:
        save = getattr(self._lock, "_release_save", None)
        return self._lock.release() if save is None else save()

    def _take_back(self, state: Any) -> None:
        restore = getattr(self._lock, "_acquire_restore", None)
        if restore is None:
            self._lock.acquire()
        else:
            restore(state)

    def wait_for(self, predicate: Callable[[], Any], timeout: float | None = None) -> Any:
        """Wait until ``predicate()`` is true; return its last value."""
        scheduler = self._script.scheduler
        deadline = None if timeout is None else scheduler.now_ns() + round(timeout * 1e9)
        result = predicate()
        while not result:
            left = None if deadline is None else (deadline - scheduler.now_ns()) / 1e9
            if left is not None and left <= 0:
                break
            self.wait(left)
            result = predicate()
        return result

    def notify(self, n: int = 1) -> None:
        """Wake ``n`` of those who wait."""
        if not self._is_owned():
            raise RuntimeError("cannot notify on un-acquired lock")
        for _ in range(min(n, len(self._waiting))):
            self._waiting.popleft().wake()

    def notify_all(self) -> None:
        """Wake all who wait."""
        self.notify(len(self._waiting))

    notifyAll = notify_all


class Event(ForScript):
    """``threading.Event``."""

    def __init__(self) -> None:
        self._set = False
        self._waiting: deque[Waiter] = deque()

    def is_set(self) -> bool:
        """Tell whether it is set."""
        return self._set

    isSet = is_set

    def set(self) -> None:
        """Set it and wake all who wait."""
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
        """Wait until it is set, for at most ``timeout`` seconds; tell whether it is."""
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


class Semaphore(ForScript):
    """``threading.Semaphore``."""

    _condition_class: ClassVar[type[Condition]]
    _lock_class: ClassVar[type[Lock]]

    def __init__(self, value: int = 1) -> None:
        if value < 0:
            raise ValueError("semaphore initial value must be >= 0")
        self._cond = self._condition_class(self._lock_class())
        self._value = value

    def acquire(self, blocking: bool = True, timeout: float | None = None) -> bool:
        """Take one; wait for it unless ``blocking`` is false, for at most ``timeout`` seconds."""
        if not blocking and timeout is not None:
            raise ValueError("can't specify timeout for non-blocking acquire")
        with self._cond:
            if not self._cond.wait_for(lambda: self._value > 0, timeout if blocking else 0):
                return False
            self._value -= 1
            return True

    def release(self, n: int = 1) -> None:
        """Give ``n`` back."""
        if n < 1:
            raise ValueError("n must be one or more")
        with self._cond:
            self._value += n
            self._cond.notify(n)

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_exc: object) -> None:
        self.release()


class BoundedSemaphore(Semaphore):
    """``threading.BoundedSemaphore``: no more can be given back than were there."""

    def __init__(self, value: int = 1) -> None:
        super().__init__(value)
        self._initial_value = value

    def release(self, n: int = 1) -> None:
        """Give ``n`` back; more than were taken is an error."""
        if n < 1:
            raise ValueError("n must be one or more")
        with self._cond:
            if self._value + n > self._initial_value:
                raise ValueError("Semaphore released too many times")
            self._value += n
            self._cond.notify(n)


class BrokenBarrierError(RuntimeError):
    """``threading.BrokenBarrierError``."""


class Barrier(ForScript):
    """``threading.Barrier``: all ``parties`` wait until the last has come."""

    _condition_class: ClassVar[type[Condition]]
    _lock_class: ClassVar[type[Lock]]

    def __init__(
        self, parties: int, action: Callable[[], object] | None = None, timeout: float | None = None
    ) -> None:
        if parties < 1:
            raise ValueError("parties must be >= 1")
        self._cond = self._condition_class(self._lock_class())
        self._parties = parties
        self._action = action
        self._timeout = timeout
        self._count = 0
        self._round = 0
        self._broken: set[int] = set()

    @property
    def parties(self) -> int:
        """How many have to come."""
        return self._parties

    @property
    def n_waiting(self) -> int:
        """How many are waiting."""
        return self._count

    @property
    def broken(self) -> bool:
        """Whether it was broken, by ``abort``, a timeout or a failing action."""
        return self._round in self._broken

    def wait(self, timeout: float | None = None) -> int:
        """Wait for the others; return a number that is different for each, 0 for one of them."""
        with self._cond:
            if self.broken:
                raise BrokenBarrierError
            this_round, index = self._round, self._count
            self._count += 1
            if self._count == self._parties:
                self._last_came()
                return index
            limit = self._timeout if timeout is None else timeout
            gone = self._cond.wait_for(lambda: self._round != this_round or self.broken, limit)
            if not gone and not self.broken:
                self._break()
            if this_round in self._broken:
                raise BrokenBarrierError
            return index

    def _last_came(self) -> None:
        try:
            if self._action is not None:
                self._action()
        except BaseException:
            self._break()
            raise
        self._next_round()

    def _next_round(self) -> None:
        self._round += 1
        self._count = 0
        self._cond.notify_all()

    def _break(self) -> None:
        self._broken.add(self._round)
        self._cond.notify_all()

    def reset(self) -> None:
        """Start again; who waits gets :class:`BrokenBarrierError`."""
        with self._cond:
            if self._count:
                self._broken.add(self._round)
            self._next_round()

    def abort(self) -> None:
        """Break the barrier for good."""
        with self._cond:
            self._break()
