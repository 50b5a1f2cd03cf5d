"""Machine code for functions in plain Python, by numba, which is optional; in a page of the book, by `wasm`."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

COMPILES = sys.platform != "emscripten"
"""Whether machine code is compiled when it is first needed, which takes seconds; a page of the book only loads it."""

LOADING = 1_000_000
"""Estimated work of all loops of a process, in plain Python or numpy, before numba is loaded [us]."""

COMPILING = 200_000
"""Estimated work of one loop before it is compiled [us]."""


class Deferral:
    """Decides when a loop is compiled: after a certain amount of work, which is estimated and never timed.

    Both versions of a loop return the same bits, so a program can switch at any call.
    """

    total = 0
    """Work of all loops of this process so far [us]."""

    def __init__(self) -> None:
        self._done = 0
        self._due = False
        self.held = False
        """If True, do not switch to machine code."""

    def due(self, work: int) -> bool:
        """Record a call that takes about `work` [us] without machine code; return whether to use machine code."""
        if not COMPILES:
            return True
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
    function: Callable[..., Any], signature: Callable[[Any], Any], helpers: Iterable[Callable[..., Any]] = ()
) -> Callable[..., Any]:
    """Return `function`, which calls `helpers`, compiled for one signature, if possible from numba's cache.

    `signature` receives numba and returns the signature. Raises `ImportError` without numba, and in a page of the book
    without the compiled loops.
    """
    if not COMPILES:
        from .wasm import WasmLoop

        return WasmLoop(function.__name__)
    with show_progress(f"compiling {function.__name__} (once on this machine) ..."):
        import numba
        from numba.extending import register_jitable

        for helper in helpers:
            register_jitable(helper)
        try:
            return numba.njit([signature(numba)], cache=True)(function)
        except Exception as error:
            # Without a usable cache (read-only installation, full disk, broken file) each start takes a
            # few seconds longer. An error in the function itself is raised again below.
            logging.getLogger(__name__).info("numba cannot cache %s: %s", function.__name__, error)
        return numba.njit([signature(numba)])(function)


def require() -> None:
    """Raise `ImportError` if there is no machine code here."""
    if not COMPILES:
        from .wasm import library

        library()
    else:
        import numba  # noqa: F401


@contextmanager
def progress(text: str) -> Iterator[None]:
    """Show a line in the terminal during the block, if standard error is a terminal, and remove it at the end."""
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


show_progress: Callable[[str], AbstractContextManager[None]] = progress
"""Shows a text while a function is compiled; a notebook replaces it."""
