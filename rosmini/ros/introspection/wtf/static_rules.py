"""Rules for the environment and the packages on the search path: faults that exist before anything runs."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from rosmini.core.errors import DefinitionError
from rosmini.core.packages import BUILT_IN, SCRIPT_FOLDERS, PackageIndex, crawl

from .findings import Finding

HEAD = 256
"""Number of bytes read from a script to find its first line."""


def missing_folders(environ: Mapping[str, str], packages: PackageIndex) -> Iterator[Finding]:  # noqa: ARG001 - a rule
    """Find folders of the search path that do not exist."""
    path = environ.get("ROS_PACKAGE_PATH", "")
    found = tuple(part for part in path.split(os.pathsep) if part and not Path(part).is_dir())
    if found:
        yield Finding(
            "missing_folders", "ERROR",
            f"Not all paths in ROS_PACKAGE_PATH [{path}] point to an existing directory:", found,
            "The terminal was set up for a workspace that has gone: source the setup file of yours again.",
        )  # fmt: skip


def broken_manifests(environ: Mapping[str, str], packages: PackageIndex) -> Iterator[Finding]:
    """Find packages that are unusable because their manifests cannot be read."""
    found = tuple(str(problem) for problem in (*packages.problems(), *_own(environ, packages)[1]))
    if found:
        yield Finding(
            "broken_manifests", "ERROR", "These manifests cannot be read, so that their packages are not found:",
            found,
        )  # fmt: skip


def missing_dependencies(environ: Mapping[str, str], packages: PackageIndex) -> Iterator[Finding]:
    """Find dependencies of the user's packages that are missing."""
    found = []
    for name in _own(environ, packages)[0]:
        missing = [each for each in packages.find(name).exec_depends if each not in packages and each not in BUILT_IN]
        if missing:
            found.append(f"{name}: {', '.join(missing)}")
    if found:
        yield Finding(
            "missing_dependencies", "WARNING", "Packages name others that are not on the search path:", tuple(found),
            "Nothing is wrong with system packages such as python3-numpy. A ROS package that is missing belongs into "
            "the workspace, or onto ROS_PACKAGE_PATH.",
        )  # fmt: skip


def unused_workspace(environ: Mapping[str, str], packages: PackageIndex) -> Iterator[Finding]:
    """Find a catkin workspace around the working folder for which this terminal was not set up."""
    here = Path.cwd()
    found = next((each for each in (here, *here.parents) if (each / "src" / "CMakeLists.txt").exists()), None)
    if found is None:
        return
    source = (found / "src").resolve()
    if any(packages.path(name).resolve().is_relative_to(source) for name in packages.names()):
        return
    if any(crawl(source)) and str(source) not in environ.get("ROS_PACKAGE_PATH", ""):
        is_built = (found / "devel" / "setup.sh").is_file()
        yield Finding(
            "unused_workspace", "WARNING", "The packages of the workspace in this folder are not found here:",
            (str(found),),
            f"In each terminal that uses it: {'' if is_built else 'catkin_make, and then '}. {found}/devel/setup.sh",
        )  # fmt: skip


def scripts_that_cannot_start(environ: Mapping[str, str], packages: PackageIndex) -> Iterator[Finding]:
    """Find scripts that rosrun would not start: not executable, no Python shebang line, or Windows line endings."""
    found = []
    for name in _own(environ, packages)[0]:
        folder = packages.path(name)
        for script in _scripts(folder):
            problem = _problem(script)
            if problem:
                found.append(f"{name}/{script.relative_to(folder).as_posix()}: {problem}")
    if found:
        yield Finding(
            "scripts_that_cannot_start", "ERROR", "A real rosrun or roslaunch cannot start these scripts:",
            tuple(found),
        )  # fmt: skip


RULES: tuple[Callable[[Mapping[str, str], PackageIndex], Iterator[Finding]], ...] = (
    missing_folders,
    broken_manifests,
    missing_dependencies,
    unused_workspace,
    scripts_that_cannot_start,
)


def _own(environ: Mapping[str, str], packages: PackageIndex) -> tuple[list[str], list[DefinitionError]]:
    """Return the packages below folders of ``ROS_PACKAGE_PATH``, and problems with manifests there."""
    roots = [Path(part).resolve() for part in environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if part]
    found: list[str] = []
    problems: list[DefinitionError] = []
    for name in packages.names():
        if any(packages.path(name).resolve().is_relative_to(root) for root in roots):
            try:
                packages.find(name)
            except DefinitionError as error:
                problems.append(error)
            else:
                found.append(name)
    return found, problems


def _scripts(folder: Path) -> list[Path]:
    """Return the Python files that are scripts, judged by their folder and by first line or name."""
    files = [each for part in SCRIPT_FOLDERS for each in sorted((folder / part).glob("*")) if each.is_file()]
    return [each for each in files if each.name != "__init__.py" and (each.suffix == ".py" or b"python" in _head(each))]


def _head(script: Path) -> bytes:
    """Return the first line of a file."""
    try:
        with script.open("rb") as file:
            return file.read(HEAD).partition(b"\n")[0]
    except OSError:
        return b""


def _problem(script: Path) -> str:
    head = _head(script)
    if not head.startswith(b"#!"):
        return "its first line is not `#!/usr/bin/env python3`" if _may_run(script) else ""  # else a module
    if head.endswith(b"\r"):
        return "its lines end as on Windows, so that the system looks for a program `python3\\r`: dos2unix"
    if b"python" not in head:
        return f"its first line starts {head[2:60].decode('utf-8', 'replace').strip()}, not python3"
    if not _may_run(script):
        return f"it has no run bit: chmod +x {shlex.quote(str(script))}"
    return ""


def _may_run(script: Path) -> bool:
    return sys.platform == "win32" or os.access(script, os.X_OK)
