"""The notebook's own catkin package: the temporary folder where cells write scripts, launch files and messages."""

from __future__ import annotations

import importlib
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

from rosmini.core.errors import UsageError

NAME = "notebook"
"""Name of the package: the same in JupyterLab, in VS Code and in a test."""

FOLDERS = ("scripts", "launch", "msg", "srv", "action")

PREFIX = "rosmini-"
_LOCK = "lock"
_VARIABLE = "ROS_PACKAGE_PATH"
_STAT_RUN = 0o755
_STAT_READ = 0o644

_MANIFEST = f"""\
<?xml version="1.0"?>
<package format="2">
  <name>{NAME}</name>
  <version>0.0.0</version>
  <description>What the cells of a notebook have written.</description>
  <maintainer email="reader@example.com">The reader</maintainer>
  <license>TODO</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>rospy</depend>
</package>
"""


class TemporaryFolder:
    """A temporary folder, removed after its process ends. Making one also removes those of killed processes.

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


class NotebookPackage:
    """A package in a temporary folder of this process; no other class writes files of a notebook.

    It is on ``ROS_PACKAGE_PATH`` of this process until :meth:`close`, which is called when the process ends at
    the latest.
    """

    def __init__(self) -> None:
        self._temporary = TemporaryFolder()
        self.workspace = self._temporary.path / "catkin_ws"
        """Folder of the catkin workspace that contains it."""
        self.folder = self.workspace / "src" / NAME
        """Folder of the package."""
        self.name = NAME
        self.folder.mkdir(parents=True)
        self._put(self.folder / "package.xml", _MANIFEST)
        self._path_before = os.environ.get(_VARIABLE)
        os.environ[_VARIABLE] = os.pathsep.join(filter(None, (str(self.folder.parent), self._path_before)))

    def file(self, kind: str, name: str) -> Path:
        """Return the path of a file of a kind (one of :data:`FOLDERS`), which need not exist.

        Raises ``UsageError`` for a name that is not a plain file name.
        """
        if kind not in FOLDERS:
            raise ValueError(f"{kind!r} is not one of the folders {', '.join(FOLDERS)}")
        plain = name.isprintable() and not set(name) & set('/\\:*?"<>|') and not name.startswith((".", "-"))
        if not name or not plain:
            raise UsageError(
                f"{name!r} is not a file name: write one without folders, such as talker.py; "
                f"the file goes into the package of this notebook"
            )
        return self.folder / kind / name

    def write(self, kind: str, name: str, text: str, *, may_run: bool = False) -> Path:
        """Write a file of the package, with or without the run bit, and return its path.

        Raises ``UsageError`` for a name that is not a plain file name.
        """
        path = self.file(kind, name)
        path.parent.mkdir(exist_ok=True)
        self._put(path, text)
        path.chmod(_STAT_RUN if may_run else _STAT_READ)
        return path

    @staticmethod
    def _put(path: Path, text: str) -> None:
        path.write_text(text, encoding="utf-8", newline="\n")

    def close(self) -> None:
        """Remove the folder, also from the search path."""
        if self._path_before is None:
            os.environ.pop(_VARIABLE, None)
        else:
            os.environ[_VARIABLE] = self._path_before
        self._temporary.remove()
