"""Which program a node is, in a process of its own: ours first, then what a ROS on this computer has."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.errors import RosminiError, ScriptError
from rosmini.core.files import exists, is_file

from .errors import Missing

if TYPE_CHECKING:
    from rosmini.core.packages import Executable, PackageIndex

    from .plan import NodePlan, Plan

INSTALLED = ("/opt/ros/noetic", "/opt/ros/melodic", "/usr")
"""Where a ROS is installed."""

ROSRUN = (sys.executable, "-m", "rosmini", "rosrun")


class Program(NamedTuple):
    """How a node is started: the first words of its command line, and the folder of its executable."""

    words: tuple[str, ...]
    folder: str


def program(node: NodePlan, packages: PackageIndex, environ: Mapping[str, str]) -> Program:
    """Return how a node is started in a process of its own. Raises as `program_of` does."""
    return program_of(node.package, node.type, packages, environ)


def program_of(package: str, name: str, packages: PackageIndex, environ: Mapping[str, str]) -> Program:
    """Return how ``package/name`` is started in a process of its own.

    Built-in nodes and Python scripts are run by `rosmini rosrun`, other files of packages by themselves, and so are the
    executables of a ROS that is installed. Raises ``UnknownPackage`` or ``ScriptError`` if there is none.
    """
    try:
        found = packages.find_executable(package, name)
    except RosminiError:
        installed = _installed(package, name, environ)
        if installed is None:
            raise
        return Program((installed,), os.path.dirname(installed))  # noqa: PTH120
    if found.path is None:
        return Program((*ROSRUN, package, name), os.getcwd())  # noqa: PTH109
    folder = str(found.path.parent)
    if is_python(found):
        return Program((*ROSRUN, package, name), folder)
    return Program((str(found.path),), folder)


def is_python(executable: Executable) -> bool:
    """Return whether a file is a script for Python, by its name or its first line."""
    if executable.path is None or executable.path.suffix == ".py":
        return executable.path is not None
    with executable.path.open("rb") as file:
        first = file.readline(200)
    return first.startswith(b"#!") and b"python" in first


def _installed(package: str, name: str, environ: Mapping[str, str]) -> str | None:
    """Return the executable of an installed ROS, at ``PREFIX/lib/PACKAGE/NAME``."""
    if any(each in ("", ".", "..") or "/" in each or "\\" in each for each in (package, name)):
        return None
    for prefix in dict.fromkeys(_prefixes(environ)):
        path = os.path.join(prefix, "lib", package, name)  # noqa: PTH118
        share = os.path.join(prefix, "share", package)  # noqa: PTH118
        if is_file(path) and exists(share) and os.access(path, os.X_OK):
            return path
    return None


def _prefixes(environ: Mapping[str, str]) -> Iterator[str]:
    yield from filter(None, environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep))
    for folder in filter(None, environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)):
        if Path(folder).name == "share":
            yield str(Path(folder).parent)
    yield from INSTALLED


def missing_programs(plan: Plan, packages: PackageIndex, environ: Mapping[str, str]) -> list[Missing]:
    """Return the packages and executables of a plan's nodes that are not there, each once."""
    found: dict[tuple[str, str], Missing] = {}
    for node in plan.all_nodes():
        try:
            program(node, packages, environ)
        except ScriptError as error:
            found.setdefault(
                ("executable", node.executable),
                Missing("executable", node.executable, node.place, str(error)),
            )
        except RosminiError as error:
            found.setdefault(
                ("package", node.package), Missing("package", node.package, node.place, str(error))
            )
    return list(found.values())
