"""Entry points of the installed distributions, read again only after something was installed or removed.

`importlib.metadata` reads the files of all distributions for each question, which takes tens of milliseconds.
"""

from __future__ import annotations

import importlib.metadata
import sys
from functools import lru_cache
from importlib.metadata import EntryPoints
from pathlib import Path


def entry_points(group: str) -> EntryPoints:
    """Return the entry points of a group, such as `rosmini.nodes`, from all distributions on `sys.path`."""
    return _read(group, tuple((place, _changed_ns(place)) for place in sys.path))


@lru_cache(maxsize=32)
def _read(group: str, _places: tuple[tuple[str, int], ...]) -> EntryPoints:
    return importlib.metadata.entry_points(group=group)


def _changed_ns(place: str) -> int:
    """Return when a folder was last changed [ns], which installing into it does; 0 if it does not exist."""
    try:
        return Path(place).stat().st_mtime_ns
    except OSError:
        return 0
