"""`rosmini catkin_make`: builds a catkin workspace: messages, services, actions, scripts, and setup files."""

from __future__ import annotations

import argparse
import shlex
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.verbs import ArgumentParser, Call, Result, Tool, VerbError, below_here

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.ros.catkin import Workspace
    from rosmini.ros.catkin.build import Report

TOOL = Tool("catkin_make", "build a catkin workspace", needs_graph=False, only_verb="make")

DESCRIPTION = """\
Build a catkin workspace: messages, services, actions, scripts, and what a shell sources. C++ is not compiled; that is
told, and all else is built."""
EPILOG = """\
Targets are `all` (the default), `clean`, which removes build and devel, and the names of packages; `install` and
`run_tests` are told as what they are. Options of CMake and make (-DNAME=VALUE, -j4) are accepted and have no effect.

for example: rosmini catkin_make -C ~/example_ws && . ~/example_ws/devel/setup.sh
"""
IGNORED = ("--use-ninja", "--use-nmake", "--use-gmake", "--force-cmake", "--no-color", "--override-build-tool-check")
NO_TESTS = "rosmini runs no tests of packages: use pytest for those in Python, and real ROS for the others"
NOT_HERE = {
    "run_tests": NO_TESTS,
    "test": NO_TESTS,
    "install": "rosmini makes no install space: what is in devel can be used as it is",
}


@dataclass(frozen=True, kw_only=True)
class Made(Result):
    """Result of a build: ``report`` names the packages that were built, were up to date, or failed."""

    report: Report | None = None


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini catkin_make",
        DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="what to make")
    parser.add_argument(
        "-C", "--directory", type=Path, default=Path(), help="the workspace (default: the working folder)"
    )
    parser.add_argument("--source", type=Path, help="the source space (default: src)")
    parser.add_argument("--build", type=Path, help="the build space (default: build)")
    parser.add_argument("--pkg", nargs="+", default=[], help="build these packages only")
    parser.add_argument(
        "--only-pkg-with-deps", nargs="+", default=[], help="build these and what they need of the workspace"
    )
    parser.add_argument("--cmake-args", nargs=argparse.REMAINDER, help="ignored: there is no CMake")
    parser.add_argument("--make-args", nargs=argparse.REMAINDER, help="ignored: there is no make")
    for option in IGNORED:
        parser.add_argument(option, action="store_true", help=argparse.SUPPRESS)
    for option in ("-D", "-j", "-l", "--jobs", "--load-average"):
        parser.add_argument(option, action="append", nargs="?", help=argparse.SUPPRESS)
    return parser


@TOOL.verb("build a catkin workspace", parser=_parser)
def make(given: argparse.Namespace, call: Call) -> Made:
    """Build the workspace; the status is 1 if a package failed. Raises ``VerbError`` if nothing can be built."""
    from rosmini.ros.catkin import CatkinError, Workspace

    base, say = Path.cwd() / given.directory, below_here(call)
    say(f"Base path: {base}")
    try:
        workspace = Workspace.at(base, given.source, given.build)
        say(f"Source space: {workspace.source}\nBuild space: {workspace.build}\nDevel space: {workspace.devel}")
        return _make(workspace, given, call, say)
    except CatkinError as error:
        raise VerbError(str(error)) from error
    except OSError as error:
        raise VerbError(f"cannot write {error.filename}: {error.strerror}") from error


def _make(workspace: Workspace, given: argparse.Namespace, call: Call, say: Callable[[str], object]) -> Made:
    from rosmini.ros.catkin import init_workspace
    from rosmini.ros.catkin import make as build

    targets = [each for each in given.targets if each != "all"]
    for each in [each for each in targets if each in NOT_HERE]:
        call.warn(f"{each}: {NOT_HERE[each]}")
        targets.remove(each)
    if "clean" in targets:
        _clean(workspace, say)
        return Made()
    if not (workspace.source / "CMakeLists.txt").exists():
        say(f'Created file "{init_workspace(workspace.source)}"')
    only = [*given.pkg, *given.only_pkg_with_deps, *targets]
    report = build(workspace, only, with_dependencies=bool(given.only_pkg_with_deps), say=say)
    _use(report.built)
    for finding in report.findings:
        call.warn(str(finding))
    say(f"{len(report.built)} built, {len(report.fresh)} up to date, {len(report.failed)} failed")
    complaints = (f"not built: {', '.join(report.failed)}",) if report.failed else ()
    if report.built and not report.failed and call.in_terminal:
        say(f"In each shell that uses it: . {shlex.quote(str(workspace.devel / 'setup.sh'))}")
    return Made(report=report, complaints=complaints, status=report.status)


def _use(packages: Sequence[str]) -> None:
    """Make this process use the new messages of packages, if it has loaded any."""
    if "rosmini.msgs" in sys.modules:
        from rosmini.msgs.importer import forget

        for package in packages:
            forget(package)


def _clean(workspace: Workspace, say: Callable[[str], object]) -> None:
    """Remove the build products."""
    import shutil

    for folder in (workspace.build, workspace.devel):
        if (folder / ".built_by").is_file() and not folder.is_symlink():
            shutil.rmtree(folder)
            say(f"Removed {folder}")
