"""A temporary folder that is removed after its process ends, even if the process was killed."""

from __future__ import annotations

import importlib
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

PREFIX = "rosmini-"

_LOCK = "lock"


class TemporaryFolder:
    """A temporary folder of this process. Making one also removes those of killed processes.

    The owner of a folder holds a lock on a file in it, which the system releases when the process ends for any reason.
    Windows has no such locks, but refuses to remove an open file.
    """

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX)).resolve()
        """Path of the folder."""
        made = self.path / f"{_LOCK}-new"
        self._lock: Any = made.open("w", encoding="utf-8")
        _take(self._lock)
        if os.name == "nt":  # an open file cannot be renamed
            self._lock.close()
            self._lock = (self.path / _LOCK).open("w", encoding="utf-8")
        else:
            made.rename(self.path / _LOCK)  # a file of this name is always locked
        if sys.platform != "emscripten":  # there flock always succeeds, and the files end with the process
            remove_abandoned(self.path.parent)

    def remove(self) -> None:
        """Remove the folder and its contents. Harmless when repeated."""
        self._lock.close()
        shutil.rmtree(self.path, ignore_errors=True)


def remove_abandoned(parent: Path) -> None:
    """Remove the folders below ``parent`` whose processes have ended without removing them."""
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
    """Lock a file. Raises ``OSError`` if another process holds the lock."""
    with suppress(ImportError):  # Windows
        fcntl: Any = importlib.import_module("fcntl")
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
