"""`rosmini rospack`: information on packages, like ROS's tool (http://wiki.ros.org/rospack)."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from rosmini.core.verbs import Call, Lines, Tool

from .package_queries import Queries
from .terminal import Terminal

if TYPE_CHECKING:
    from rosmini.tools.dependencies import Dependencies

TOOL = Tool("rospack", "packages: where they are, what they need, what they export", usage_status=1, needs_graph=False)
QUERIES = Queries(TOOL, stacks=False)
QUERIES.register()
add_parser, main = Terminal(TOOL).add_parser, QUERIES.main


@TOOL.verb("list what packages export to one: its plugins", parser=QUERIES.parser("plugins", "attrib", named="package"))
def plugins(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the exports of packages for another one: an attribute's value of each, with ``${prefix}`` replaced."""
    if not given.attrib:
        raise QUERIES.error("no package / attrib given")

    def ask(known: Dependencies, name: str) -> list[str]:
        known.path(name)
        asked = known.dependents(name, direct=True)[0]
        return [f"{each} {value}" for each in (name, *asked) for value in _exported(known, each, name, given.attrib)]

    return QUERIES.lines(given, ask)


def _exported(known: Dependencies, package: str, tag: str, attribute: str) -> list[str]:
    """Return the values of an attribute of the exports with this tag."""
    found = known.index.find(package)
    values = (each.get(attribute) for each in found.exports if each.tag == tag)
    return [value.replace("${prefix}", str(found.path)) for value in values if value is not None]
