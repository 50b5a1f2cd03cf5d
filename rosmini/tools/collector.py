"""Controls how often Python's garbage collector runs in processes of rosmini."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

OBJECTS = 10_000
"""Number of new objects that triggers a collection; Python's default of 700 is one instant of a hundred robots."""


@contextmanager
def seldom() -> Iterator[None]:
    """Make the collector run less often within the block, if it does not already.

    Messages are many small objects that are freed without a collector as soon as nothing refers to them. Those that are
    being transmitted during a collection count as old afterwards, and many of these trigger a full collection, which
    takes a tenth of a second: with a hundred robots a fifth of all time.
    """
    before = gc.get_threshold()
    gc.set_threshold(max(OBJECTS, before[0]), *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)
