"""Python's collector of garbage in a process that is ours: how often it looks."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

OBJECTS = 10_000
"""So many more objects than after the last run start it again; Python's own 700 are one instant of a hundred robots."""


@contextmanager
def seldom() -> Iterator[None]:
    """Let the collector look more seldom, if it does not do so already.

    Messages are many small objects that go as soon as nobody holds them, without a collector. Those that are on their
    way when it looks count as old from then on, and many of these let it look through everything there is, which
    takes a tenth of a second: with a hundred robots a fifth of all time.
    """
    before = gc.get_threshold()
    gc.set_threshold(max(OBJECTS, before[0]), *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)
