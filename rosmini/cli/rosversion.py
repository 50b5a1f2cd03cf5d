"""`rosmini rosversion`: the version of a package, or the name of the distribution."""

from __future__ import annotations

import argparse
import os
import sys

from rosmini.errors import UnknownPackage, nearest
from rosmini.packages import PackageIndex

EPILOG = "for example: rosmini rosversion std_msgs"
DISTRIBUTION = "noetic"
"""The ROS that rosmini is, where ROS_DISTRO names no other."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `rosversion`."""
    parser = subparsers.add_parser(
        "rosversion", help="the version of a package", description=__doc__, epilog=EPILOG
    )
    parser.add_argument("-s", "--skip-newline", action="store_true", help="end without a newline")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("package", nargs="?", help="the name of a package")
    what.add_argument("-d", "--distro", action="store_true", help="the name of the distribution")
    what.add_argument("-a", "--all", action="store_true", help="all packages and their versions")
    return parser


def version(package: str, index: PackageIndex) -> str:
    """The version of a package or of a stack. Raises `UnknownPackage`."""
    if package in index.stacks():
        return index.find_stack(package).version or "<unversioned>"
    return index.find(package).version or "<unversioned>"


def main(args: argparse.Namespace) -> int:
    """Print it; 1 if there is no such package."""
    end = "" if args.skip_newline else "\n"
    if args.distro:
        print(os.environ.get("ROS_DISTRO") or DISTRIBUTION, end=end)
        return 0
    index = PackageIndex()
    if args.all:
        print("\n".join(f"{name}: {version(name, index)}" for name in index.names()), end=end)
        return 0
    try:
        print(version(args.package, index), end=end)
    except UnknownPackage:
        hint = nearest(args.package, [*index.names(), *index.stacks()])
        print(f"Cannot locate [{args.package}]")
        if hint:
            print(hint, file=sys.stderr)
        return 1
    return 0
