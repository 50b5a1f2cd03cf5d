"""`rosmini catkin_create_pkg`: creates a package in a new folder, like catkin's own tool."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.verbs import ArgumentParser, Call, Result, Tool, VerbError, below_here

if TYPE_CHECKING:
    import argparse

TOOL = Tool("catkin_create_pkg", "make a new package", needs_graph=False, only_verb="create")


@dataclass(frozen=True, kw_only=True)
class Created(Result):
    """A package that was created in the folder ``path``."""

    path: Path


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini catkin_create_pkg",
        "Make a new package in a folder of its own.",
        epilog="for example, in the src of a workspace: rosmini catkin_create_pkg example_pkg std_msgs rospy",
    )
    parser.add_argument("name", help="the name of the package")
    parser.add_argument("dependencies", nargs="*", help="the packages that it needs")
    parser.add_argument("--meta", action="store_true", help="make a metapackage, which only gathers others")
    parser.add_argument("-s", "--sys-deps", nargs="*", default=[], help="libraries of the system that it needs")
    parser.add_argument("-b", "--boost-comps", nargs="*", default=[], help="parts of Boost that it needs")
    parser.add_argument("-V", "--pkg_version", default="0.0.0", help="its version (default: 0.0.0)")
    parser.add_argument("-D", "-d", "--description", default="", help="what it is")
    parser.add_argument(
        "-l", "--license", action="append", default=[], help="a licence, such as BSD or MIT; more than once"
    )
    parser.add_argument("-a", "--author", action="append", default=[], help="who wrote it; may be given more than once")
    parser.add_argument("-m", "--maintainer", action="append", default=[], help="who looks after it; more than once")
    parser.add_argument("--rosdistro", help="accepted, and of no effect: the files are the same for all")
    return parser


@TOOL.verb("make a new package", parser=_parser)
def create(given: argparse.Namespace, call: Call) -> Created:
    """Create the package. Raises ``VerbError`` with the original's status on failure."""
    from rosmini.ros.catkin import CatkinError, NewPackage, create_package

    new = NewPackage(
        given.name, tuple(dict.fromkeys(given.dependencies)), given.description, tuple(given.license),
        tuple(given.author), tuple(given.maintainer), given.pkg_version, tuple(given.sys_deps),
        tuple(given.boost_comps), given.meta,
    )  # fmt: skip
    try:
        odd = create_package(new, Path.cwd(), below_here(call))
    except (CatkinError, OSError) as error:
        raise VerbError(f"catkin_create_pkg: error: {error}", 2) from error
    return Created(path=Path.cwd() / new.name, complaints=tuple(f"WARNING: {each}" for each in odd))
