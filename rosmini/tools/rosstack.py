"""`rosmini rosstack`: information on stacks and metapackages, like ROS's tool (http://wiki.ros.org/rosstack)."""

from __future__ import annotations

import argparse

from rosmini.core.verbs import Call, Lines, Tool

from .package_queries import Queries
from .terminal import Terminal

TOOL = Tool("rosstack", "stacks and metapackages: where they are, what is in them", usage_status=1, needs_graph=False)
QUERIES = Queries(TOOL, stacks=True)
QUERIES.register()
add_parser, main = Terminal(TOOL).add_parser, QUERIES.main


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
