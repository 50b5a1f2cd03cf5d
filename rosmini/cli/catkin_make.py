"""`rosmini catkin_make`: builds a catkin workspace: messages, services, actions, scripts, and what a shell sources.

C++ is not compiled; that is told, and all else is built.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rosmini.catkin import Workspace

EPILOG = """\
Targets are `all` (the default), `clean`, which removes build and devel, and the names of packages; `install` and
`run_tests` are told as what they are. Options of CMake and make (-DNAME=VALUE, -j4) are accepted and have no effect.

for example: rosmini catkin_make -C ~/example_ws && . ~/example_ws/devel/setup.sh
"""
IGNORED = (
    "--use-ninja",
    "--use-nmake",
    "--use-gmake",
    "--force-cmake",
    "--no-color",
    "--override-build-tool-check",
)
NO_TESTS = "rosmini runs no tests of packages: use pytest for those in Python, and real ROS for the others"
NOT_HERE = {
    "run_tests": NO_TESTS,
    "test": NO_TESTS,
    "install": "rosmini makes no install space: what is in devel can be used as it is",
}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `catkin_make`."""
    parser = subparsers.add_parser(
        "catkin_make",
        help="build a catkin workspace",
        description=__doc__,
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


def main(args: argparse.Namespace) -> int:
    """Build it; 1 if a package could not be built."""
    from rosmini.catkin import CatkinError, Workspace, init_workspace, make

    base = Path.cwd() / args.directory
    print(f"Base path: {base}")
    try:
        workspace = Workspace.at(base, args.source, args.build)
        print(
            f"Source space: {workspace.source}\nBuild space: {workspace.build}\nDevel space: {workspace.devel}"
        )
        targets = [each for each in args.targets if each != "all"]
        for each in [each for each in targets if each in NOT_HERE]:
            print(f"{each}: {NOT_HERE[each]}", file=sys.stderr)
            targets.remove(each)
        if "clean" in targets:
            return _clean(workspace)
        if not (workspace.source / "CMakeLists.txt").exists():
            print(f'Created file "{init_workspace(workspace.source)}"')
        only = [*args.pkg, *args.only_pkg_with_deps, *targets]
        report = make(workspace, only, with_dependencies=bool(args.only_pkg_with_deps))
    except CatkinError as error:
        print(error, file=sys.stderr)
        return 1
    except OSError as error:
        print(f"cannot write {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    for finding in report.findings:
        print(finding, file=sys.stderr)
    print(f"{len(report.built)} built, {len(report.fresh)} up to date, {len(report.failed)} failed")
    if report.failed:
        print(f"not built: {', '.join(report.failed)}", file=sys.stderr)
    elif report.built:
        print(f"In each shell that uses it: . {workspace.devel / 'setup.sh'}")
    return report.status


def _clean(workspace: Workspace) -> int:
    """Remove what was built."""
    import shutil

    for folder in (workspace.build, workspace.devel):
        if (folder / ".built_by").is_file() and not folder.is_symlink():
            shutil.rmtree(folder)
            print(f"Removed {folder}")
    return 0
