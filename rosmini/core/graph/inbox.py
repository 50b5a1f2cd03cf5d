"""What other threads and signal handlers want done by the thread that runs the queue."""

from __future__ import annotations

import threading
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

T = TypeVar("T")


class Sleeper(Protocol):
    """Where the reader sleeps instead, to be woken by more than the inbox."""

    is_asleep: bool

    def sleep(self, timeout: float, nothing_came: Callable[[], bool]) -> None:
        """Sleep for at most `timeout` seconds, unless something came before `is_asleep` was true."""

    def wake(self) -> None:
        """Wake the reader. From any thread, and from a signal's handler."""


class Inbox(Generic[T]):
    """A queue with any number of writers and one reader. A writer may interrupt another in the middle of `put`.

    Not a ``queue.SimpleQueue``: until Python 3.12 its ``get`` may wait for ever where the time-out is over before it
    waits at all, as it is on a busy machine.
    """

    def __init__(self) -> None:
        self._items: deque[T] = deque()
        self._bell = threading.Lock()  # free while nobody has looked since something came
        self._bell.acquire()
        self.sleeper: Sleeper | None = None

    def put(self, item: T) -> None:
        """Add something, and wake the reader."""
        self._items.append(item)
        sleeper = self.sleeper
        if sleeper is not None and sleeper.is_asleep:
            sleeper.wake()
            return
        with suppress(RuntimeError):  # it was free already
            self._bell.release()

    def empty(self) -> bool:
        """Return whether there is nothing."""
        return not self._items

    def get(self) -> T:
        """Return the oldest thing. Raises ``IndexError`` if there is nothing."""
        return self._items.popleft()

    def wait(self, timeout: float) -> None:
        """Wait for at most `timeout` seconds until there is something; it may also return for no reason."""
        sleeper = self.sleeper
        if sleeper is not None:
            sleeper.sleep(timeout, self.empty)
        elif not self._items:
            self._bell.acquire(timeout=timeout)
