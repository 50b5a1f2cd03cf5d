"""`rosmini roscd`: where a package is, for `cd`: no program can change the folder of the shell that runs it.

The shell function is ``roscd() { cd "$(rosmini roscd "$@")"; }``.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini import files
from rosmini.errors import RosminiError, UnknownPackage, nearest
from rosmini.packages import PackageIndex

if TYPE_CHECKING:
    from collections.abc import Mapping

LOG = "log"
"""The name by which `roscd` and `rosls` know the folder of log files, and no package."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `roscd`."""
    parser = subparsers.add_parser(
        "roscd",
        help="print the folder of a package, for cd",
        description=__doc__,
        epilog="for example: cd $(rosmini roscd turtlebot3_description/urdf)",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("location", nargs="?", help="PACKAGE or PACKAGE/FOLDER; by default the workspace")
    return parser


def located(location: str, command: str, index: PackageIndex | None = None) -> Path:
    """What ``package/path`` means: the package's folder, or what is in it.

    Raises `RosminiError`, as ``command`` says it, if there is no such package or path.
    """
    name, _, rest = location.partition("/")
    index = PackageIndex() if index is None else index
    if name == LOG:
        folder = Path(
            os.environ.get("ROS_LOG_DIR") or Path(os.environ.get("ROS_HOME") or Path.home() / ".ros", "log")
        )
    elif name in index.stacks() and name not in index:
        folder = index.find_stack(name).path
    else:
        try:
            folder = index.path(name)
        except UnknownPackage as error:
            hint = nearest(name, [*index.names(), *index.stacks()])
            raise RosminiError(f"No such package/stack '{name}'{f'; {hint}' if hint else ''}") from error
    path = folder / rest if rest else folder
    if not files.exists(path):
        hint = nearest(path.name, files.names_in(path.parent))
        raise RosminiError(f"cannot {command} {path}: No such file or directory{f'; {hint}' if hint else ''}")
    return path


def workspace(environ: Mapping[str, str]) -> Path:
    """The workspace that is in use: ROS_WORKSPACE, or the first devel space of CMAKE_PREFIX_PATH.

    Raises `RosminiError` if there is none.
    """
    if environ.get("ROS_WORKSPACE"):
        return Path(environ["ROS_WORKSPACE"])
    for part in environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        if part and Path(part, ".catkin").is_file():
            return Path(part)
    raise RosminiError(
        "Neither ROS_WORKSPACE is set nor a catkin workspace is listed in CMAKE_PREFIX_PATH.  Please set ROS_WORKSPACE "
        "or source a catkin workspace to use roscd with no arguments."
    )


def main(args: argparse.Namespace) -> int:
    """Print the folder."""
    path = located(args.location, "cd to") if args.location else workspace(os.environ)
    if not path.is_dir():
        raise RosminiError(f"{path} is a file, not a folder; its folder is {path.parent}")
    print(path)
    return 0
