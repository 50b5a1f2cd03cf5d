"""`rosmini rosstack`: information on stacks and metapackages, like ROS's tool (http://wiki.ros.org/rosstack)."""

from __future__ import annotations

import argparse

from rosmini.core.packages import PackageIndex
from rosmini.core.verbs import Call, Lines, Tool

from .package_queries import Queries
from .terminal import Terminal

TOOL = Tool("rosstack", "stacks and metapackages: where they are, what is in them", usage_status=1, needs_graph=False)
QUERIES = Queries(TOOL, stacks=True)
QUERIES.register()
add_parser, main = Terminal(TOOL).add_parser, QUERIES.main


def _container(index: PackageIndex, package: str) -> str:
    """Return the stack that contains a package, which is the package itself. Raises ``VerbError`` if it is unknown."""
    if package in index:
        return package
    raise QUERIES.error(f"stack containing package {package} not found")


@TOOL.verb("list the packages in a stack", parser=QUERIES.parser("contents", named="stack"))
def contents(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the dependencies of a metapackage; any other stack has no packages."""
    known = QUERIES.known()
    name = QUERIES.name(given, known)
    index = known.index
    with QUERIES.original_errors(f"no such stack {name}"):
        known.path(name)
        gathered = index.find(name).exec_depends if name in index.metapackages() else ()
        return Lines(lines=gathered)


@TOOL.verb("print the stack that a package is in", parser=QUERIES.parser("contains", named="package"))
def contains(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the name of the stack that contains a package."""
    index = PackageIndex()
    return Lines(lines=(_container(index, given.name or QUERIES.name(given, QUERIES.known())),))


@TOOL.verb(
    "print the folder of the stack that a package is in",
    name="contains-path",
    parser=QUERIES.parser("contains-path", named="package"),
)
def contains_path(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the folder of the stack that contains a package."""
    known = QUERIES.known()
    name = _container(known.index, given.name or QUERIES.name(given, known))
    return Lines(lines=(str(known.path(name)),))
