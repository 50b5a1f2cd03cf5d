"""A temporary folder that is gone after its process, also where that was killed."""

from __future__ import annotations

import importlib
import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

PREFIX = "rosmini-"

_LOCK = "lock"


class TemporaryFolder:
    """A folder of this process. Making one also removes those of processes that were killed.

    Who owns a folder holds a lock on a file in it, which the system releases when the process ends in whatever way;
    where there are no such locks (Windows), an open file cannot be removed.
    """

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
        """Where it is."""
        made = self.path / f"{_LOCK}-new"
        self._lock: Any = made.open("w", encoding="utf-8")
        _take(self._lock)
        if os.name == "nt":  # nor can it be renamed
            self._lock.close()
            self._lock = (self.path / _LOCK).open("w", encoding="utf-8")
        else:
            made.rename(self.path / _LOCK)  # what is called so is locked
        remove_abandoned(self.path.parent)

    def remove(self) -> None:
        """Remove it with all that is in it. Harmless when repeated."""
        self._lock.close()
        shutil.rmtree(self.path, ignore_errors=True)


def remove_abandoned(parent: Path) -> None:
    """Remove the folders below ``parent`` whose processes have ended without doing so."""
    for folder in parent.glob(f"{PREFIX}*"):
        with suppress(OSError):
            lock = folder / _LOCK
            if os.name == "nt":
                lock.unlink()
            else:
                with lock.open("r+", encoding="utf-8") as file:
                    _take(file)
            shutil.rmtree(folder, ignore_errors=True)


def _take(file: Any) -> None:
    """Lock a file. Raises ``OSError`` if another process has."""
    with suppress(ImportError):  # Windows
        fcntl: Any = importlib.import_module("fcntl")
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
