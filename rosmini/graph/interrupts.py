"""Ctrl-C while a graph is driven: it stops the drive, not whichever node happened to run."""

from __future__ import annotations

import signal
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

PATIENCE_S = 1.0
"""After how long a Ctrl-C that has ended nothing yet says what it waits for."""


class InterruptGuard:
    """Turns the first SIGINT during a drive into a note that the scheduler reads between two events.

    A second SIGINT before the first was read is raised in place: the running callback does not come back. Until then a thread says what
    is waited for, because nothing else can. Outside the main thread Python delivers no signals, and the guard does nothing.

    ``wake`` lets the scheduler look; ``running`` names what it runs.
    """

    def __init__(self, wake: Callable[[], None], running: Callable[[], str]) -> None:
        self._wake = wake
        self._running = running
        self._told: threading.Timer | None = None
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
        if self._told is not None:
            self._told.cancel()
            self._told = None
        return noted

    def _handle(self, _signum: int, frame: FrameType | None) -> None:
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        self._wake()
        place = users_place(frame)
        if place:
            self._told = threading.Timer(PATIENCE_S, self._tell, (place,))
            self._told.daemon = True
            self._told.start()

    def _tell(self, place: str) -> None:
        if self.noted:
            sys.stderr.write(
                f"Ctrl-C: waiting for {self._running()} to come back from {place}. Press Ctrl-C again to end it at once.\n"
            )


def users_place(frame: FrameType | None) -> str:
    """Return which function of the user's runs in ``frame``, the outermost one, and at which line; empty for rosmini's own code."""
    found: FrameType | None = None
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if not module.startswith("rosmini."):
            found = frame
        elif found is not None and module.startswith("rosmini.graph."):
            break  # who called it
        frame = frame.f_back
    if frame is None or found is None:
        return ""
    code = found.f_code
    return f"{code.co_name} ({Path(code.co_filename).name}, line {found.f_lineno})"
