"""`rosmini roscd`: prints the folder of a package for `cd`, since no program can change the folder of its shell.

The shell function is ``roscd() { cd "$(rosmini roscd "$@")"; }``. In Python it changes the working folder itself.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core import files
from rosmini.core.errors import RosminiError, UnknownPackage, nearest
from rosmini.core.packages import DEVEL_MARKER, PackageIndex
from rosmini.core.verbs import ArgumentParser, Call, Result, Tool

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping

LOG = "log"
"""Name of the folder of log files in `roscd` and `rosls`; not a package."""


TOOL = Tool("roscd", "go to the folder of a package", needs_graph=False, only_verb="go")


@dataclass(frozen=True, kw_only=True)
class Folder(Result):
    """The folder for ``roscd``; its text is the argument of `cd` in a terminal."""

    path: Path
    is_entered: bool

    def __str__(self) -> str:
        return "" if self.is_entered else str(self.path)


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini roscd",
        "Print the folder of a package, for cd; in a notebook, go there.",
        epilog="for example: cd $(rosmini roscd turtlebot3_description/urdf)",
    )
    parser.add_argument("location", nargs="?", help="PACKAGE or PACKAGE/FOLDER; by default the workspace")
    return parser


def located(location: str, command: str, index: PackageIndex | None = None) -> Path:
    """Return the path of ``package/path``: the package's folder, or something in it.

    Raises `RosminiError`, in the words of ``command``, if there is no such package or path.
    """
    name, _, rest = location.partition("/")
    index = PackageIndex() if index is None else index
    if name == LOG:
        folder = Path(os.environ.get("ROS_LOG_DIR") or Path(os.environ.get("ROS_HOME") or Path.home() / ".ros", "log"))
    else:
        try:
            folder = index.path(name)
        except UnknownPackage as error:
            hint = nearest(name, index.names())
            raise RosminiError(f"No such package/stack '{name}'{f'; {hint}' if hint else ''}") from error
    path = folder / rest if rest else folder
    if not files.exists(path):
        hint = nearest(path.name, files.names_in(path.parent))
        raise RosminiError(f"cannot {command} {path}: No such file or directory{f'; {hint}' if hint else ''}")
    return path


def workspace(environ: Mapping[str, str]) -> Path:
    """Return the workspace in use: ROS_WORKSPACE, or the first devel space of CMAKE_PREFIX_PATH.

    Raises `RosminiError` if no workspace is in use.
    """
    if environ.get("ROS_WORKSPACE"):
        return Path(environ["ROS_WORKSPACE"])
    for part in environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        if part and Path(part, DEVEL_MARKER).is_file():
            return Path(part)
    raise RosminiError(
        "Neither ROS_WORKSPACE is set nor a catkin workspace is listed in CMAKE_PREFIX_PATH.  Please set ROS_WORKSPACE "
        "or source a catkin workspace to use roscd with no arguments."
    )


@TOOL.verb("go to the folder of a package", parser=_parser, takes="location")
def go(given: argparse.Namespace, call: Call) -> Folder:
    """Change to the folder; a terminal prints it. Raises ``RosminiError`` if it does not exist."""
    path = located(given.location, "cd to") if given.location else workspace(os.environ)
    if not path.is_dir():
        raise RosminiError(f"{path} is a file, not a folder; its folder is {path.parent}")
    if not call.in_terminal:
        os.chdir(path)
    return Folder(path=path, is_entered=not call.in_terminal)
