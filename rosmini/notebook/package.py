"""The notebook's own catkin package: where its cells write scripts, launch files and messages."""

from __future__ import annotations

import os
from pathlib import Path

from rosmini.core.errors import UsageError

from .folder import TemporaryFolder

NAME = "notebook"
"""Name of the package: the same in JupyterLab, in VS Code and in a test."""

FOLDERS = ("scripts", "launch", "msg", "srv", "action")

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
