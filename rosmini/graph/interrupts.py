"""Ctrl-C while a graph is driven: it stops the drive, not whichever node happened to run."""

from __future__ import annotations

import signal
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable


class InterruptGuard:
    """Turns the first SIGINT during a drive into a note that the scheduler reads between two events.

    A second SIGINT before the first was read is raised in place: the running callback does not come back.
    Outside the main thread Python delivers no signals, and the guard does nothing.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self.noted = False
        """An interrupt came that nobody has taken yet."""
        self._depth = 0
        self._previous: Any = None

    def arm(self) -> None:
        """Start to catch SIGINT, if this is the main thread and Python's handling was not switched off."""
        self._depth += 1
        if self._depth > 1 or threading.current_thread() is not threading.main_thread():
            return
        previous = signal.getsignal(signal.SIGINT)
        if callable(previous):
            self._previous = previous
            signal.signal(signal.SIGINT, self._handle)

    def disarm(self) -> None:
        """Give SIGINT back."""
        self._depth -= 1
        if self._depth == 0 and self._previous is not None:
            signal.signal(signal.SIGINT, self._previous)
            self._previous = None

    def take(self) -> bool:
        """Return whether an interrupt was noted, and forget it."""
        noted, self.noted = self.noted, False
        return noted

    def _handle(self, _signum: int, _frame: Any) -> None:
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        self._wake()
