"""Machine code of functions that are plain Python: the only use of numba, which is optional."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

LOADING = 1_000_000
"""Work [us] of all loops of a process in plain Python, or numpy, before numba is loaded for them."""

COMPILING = 200_000
"""Work [us] of one loop before it is compiled."""


class Deferral:
    """Decides when a loop is compiled: after an amount of work, which is counted and never measured with a clock.

    Both forms of a loop return the same bits, so a program may change from one to the other at any call.
    """

    total = 0
    """Work of all loops of this process [us]."""

    def __init__(self) -> None:
        self._done = 0
        self._due = False
        self.held = False
        """Whether to go on without machine code that is not in use yet."""

    def due(self, work: int) -> bool:
        """Count a call that takes this time [us] without machine code; return whether to use machine code for it."""
        if not self._due and not self.held:
            self._done += work
            Deferral.total += work
            loaded = "numba" in sys.modules or Deferral.total > LOADING
            self._due = self._done > COMPILING and loaded
        return self._due

    def force(self) -> None:
        """Use machine code from now on."""
        self._due = True


def machine_code(
    function: Callable[..., Any], signature: Any, helpers: Iterable[Callable[..., Any]] = ()
) -> Callable[..., Any]:
    """Compile `function`, which calls `helpers`, for one signature of numba's types, or load it from numba's cache.

    Raises `ImportError` without numba.
    """
    with progress(f"compiling {function.__name__} (once on this machine) ..."):
        import numba
        from numba.extending import register_jitable

        for helper in helpers:
            register_jitable(helper)
        try:
            return numba.njit([signature], cache=True)(function)
        except Exception as error:
            # Without a usable cache (an installation for all users, a full disk, a broken file) each start takes a
            # few seconds longer. An error in the function itself is raised again below.
            logging.getLogger(__name__).info("numba cannot cache %s: %s", function.__name__, error)
        return numba.njit([signature])(function)


@contextmanager
def progress(text: str) -> Iterator[None]:
    """Show a line in the terminal, if standard error is one, and remove it at the end."""
    stream = sys.__stderr__
    if stream is None or not stream.isatty():
        yield
        return
    stream.write(f"\r{text}")
    stream.flush()
    try:
        yield
    finally:
        stream.write("\r" + " " * len(text) + "\r")
        stream.flush()
