"""Finds the program that runs a node in a separate process: rosmini's first, then that of an installed ROS."""

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
"""Folders in which ROS may be installed."""

ROSRUN = (sys.executable, "-m", "rosmini", "rosrun")


class Program(NamedTuple):
    """How to start a node: the first words of its command line, and the folder of its executable."""

    words: tuple[str, ...]
    folder: str


def program(node: NodePlan, packages: PackageIndex, environ: Mapping[str, str]) -> Program:
    """Return how to start a node in a separate process. Raises the errors of `program_of`."""
    return program_of(node.package, node.type, packages, environ)


def program_of(package: str, name: str, packages: PackageIndex, environ: Mapping[str, str]) -> Program:
    """Return how to start ``package/name`` in a separate process.

    Built-in nodes and Python scripts are run by `rosmini rosrun`; other files of packages run directly, and so do the
    executables of an installed ROS. Raises ``UnknownPackage`` or ``ScriptError`` if it is not found.
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
    """Return True if a file is a Python script, judged by its name or first line."""
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
    """Return the missing packages and executables of a plan's nodes, without duplicates."""
    found: dict[tuple[str, str], Missing] = {}
    for node in plan.all_nodes():
        try:
            program(node, packages, environ)
        except ScriptError as error:
            found.setdefault(
                ("executable", node.executable), Missing("executable", node.executable, node.place, str(error))
            )
        except RosminiError as error:
            found.setdefault(("package", node.package), Missing("package", node.package, node.place, str(error)))
    return list(found.values())
