"""How code is suspended and continued: by greenlet, or by JavaScript promises on Emscripten, which has no threads."""

from __future__ import annotations

import sys
import threading
from typing import TypeVar

__all__ = ["HAS_THREADS", "GreenletExit", "getcurrent", "greenlet", "held_lock", "yielding"]

F = TypeVar("F")

HAS_THREADS = sys.platform != "emscripten"
"""Whether this Python can start threads."""

if sys.platform == "emscripten":
    from .promise_stacks import GreenletExit, getcurrent, greenlet, held_lock, yielding
else:
    from greenlet import GreenletExit, getcurrent, greenlet

    def held_lock() -> threading.Lock:
        """Return a lock that is held."""
        lock = threading.Lock()
        lock.acquire()
        return lock

    def yielding(poll: F) -> F:
        """Return ``poll``: no page waits for its events."""
        return poll
