"""Rules for the environment and the packages on the search path: faults that exist before anything runs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from rosmini.core.errors import DefinitionError
from rosmini.core.packages import BUILT_IN, PackageIndex, crawl

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


RULES: tuple[Callable[[Mapping[str, str], PackageIndex], Iterator[Finding]], ...] = (
    missing_folders,
    broken_manifests,
    missing_dependencies,
    unused_workspace,
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
