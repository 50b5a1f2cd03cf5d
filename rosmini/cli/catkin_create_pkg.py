"""`rosmini catkin_create_pkg`: a new package in a folder of its own, as catkin's own tool makes it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `catkin_create_pkg`."""
    parser = subparsers.add_parser(
        "catkin_create_pkg",
        help="make a new package",
        description=__doc__,
        epilog="for example, in the src of a workspace: rosmini catkin_create_pkg example_pkg std_msgs rospy",
    )
    parser.add_argument("name", help="the name of the package")
    parser.add_argument("dependencies", nargs="*", help="the packages that it needs")
    parser.add_argument("--meta", action="store_true", help="make a metapackage, which only gathers others")
    parser.add_argument(
        "-s", "--sys-deps", nargs="*", default=[], help="libraries of the system that it needs"
    )
    parser.add_argument("-b", "--boost-comps", nargs="*", default=[], help="parts of Boost that it needs")
    parser.add_argument("-V", "--pkg_version", default="0.0.0", help="its version (default: 0.0.0)")
    parser.add_argument("-D", "-d", "--description", default="", help="what it is")
    parser.add_argument(
        "-l", "--license", action="append", default=[], help="a licence, such as BSD or MIT; more than once"
    )
    parser.add_argument(
        "-a", "--author", action="append", default=[], help="who wrote it; may be given more than once"
    )
    parser.add_argument(
        "-m", "--maintainer", action="append", default=[], help="who looks after it; more than once"
    )
    parser.add_argument("--rosdistro", help="accepted, and of no effect: the files are the same for all")
    return parser


def main(args: argparse.Namespace) -> int:
    """Make it; 2 if that cannot be, as the original."""
    from rosmini.catkin import CatkinError, NewPackage, create_package

    new = NewPackage(
        args.name, tuple(dict.fromkeys(args.dependencies)), args.description, tuple(args.license), tuple(args.author),
        tuple(args.maintainer), args.pkg_version, tuple(args.sys_deps), tuple(args.boost_comps), args.meta,
    )  # fmt: skip
    try:
        odd = create_package(new, Path.cwd())
    except (CatkinError, OSError) as error:
        print(f"catkin_create_pkg: error: {error}", file=sys.stderr)
        return 2
    for each in odd:
        print(f"WARNING: {each}", file=sys.stderr)
    return 0
