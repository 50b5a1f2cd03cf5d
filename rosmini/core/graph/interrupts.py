"""Ctrl-C while a graph is driven: it stops the drive, not whichever node happened to run."""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]
import sys
import threading
from pathlib import Path
from signal import SIGINT
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

PATIENCE_S = 1.0
"""After how long a Ctrl-C that has not ended anything yet says what it waits for."""

MAIN_THREAD = threading.main_thread().ident

# The functions of ``signal`` itself turn numbers into enums and back: 5 us, each time that somebody blocks.
_get_handler, _set_handler, _SIGINT = _signal.getsignal, _signal.signal, int(SIGINT)


class InterruptGuard:
    """Turns the first SIGINT during a drive into a note that the scheduler reads between two events.

    A second SIGINT before the first was read is raised in place: the running callback does not come back. Until then a
    thread says what is waited for, because nothing else can. Outside the main thread Python delivers no signals, and
    the guard does nothing.

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
        """Catch SIGINT if this is the main thread and Python's handling is not switched off."""
        self._depth += 1
        if self._depth > 1 or threading.get_ident() != MAIN_THREAD:
            return
        if callable(_get_handler(_SIGINT)):
            self._previous = _set_handler(_SIGINT, self._handle)

    def disarm(self) -> None:
        """Give SIGINT back."""
        self._depth -= 1
        if self._depth == 0 and self._previous is not None:
            _set_handler(_SIGINT, self._previous)
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
                f"Ctrl-C: waiting for {self._running()} to come back from {place}. Press Ctrl-C again to end it at "
                "once.\n"
            )


def users_place(frame: FrameType | None) -> str:
    """Return which function of the user's runs in ``frame``, the outermost one, and at which line.

    Empty for rosmini's own code.
    """
    found: FrameType | None = None
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if not module.startswith("rosmini."):
            found = frame
        elif found is not None and module.startswith("rosmini.core.graph."):
            break  # who called it
        frame = frame.f_back
    if frame is None or found is None:
        return ""
    code = found.f_code
    return f"{code.co_name} ({Path(code.co_filename).name}, line {found.f_lineno})"
