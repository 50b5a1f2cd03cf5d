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

COMPILING = "cflags-only-I cflags-only-other libs-only-L libs-only-l libs-only-other"
SYSTEM = "rosdep rosdeps rosdep0 rosdeps0"
VERSION_CONTROL = "vcs vcs0"


@TOOL.verb(
    "list packages that are found more than once", name="list-duplicates", parser=QUERIES.parser("list-duplicates")
)
def list_duplicates(_given: argparse.Namespace, _call: Call) -> Lines:
    """Return each package that is found more than once, with its folders; the first is used."""
    found = QUERIES.known().index.duplicates()
    return Lines(
        lines=tuple(line for name, paths in found.items() for line in (name, *(f"- {path}" for path in paths)))
    )


@TOOL.verb(
    "list what packages export to one: its plugins", parser=QUERIES.parser("plugins", "attrib", "top", named="package")
)
def plugins(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the exports of packages for another one: an attribute's value of each, with ``${prefix}`` replaced."""
    if not given.attrib:
        raise QUERIES.error("no package / attrib given")

    def ask(known: Dependencies, name: str) -> list[str]:
        known.path(name)
        asked = known.dependents(name, direct=True)[0]
        if given.top:
            asked = [each for each in asked if each in {given.top, *known.all_of(given.top)}]
        return [f"{each} {value}" for each in (name, *asked) for value in _exported(known, each, name, given.attrib)]

    return QUERIES.lines(given, ask)


@TOOL.verb(
    "print what a package and all that it needs export for a language",
    parser=QUERIES.parser("export", "lang", "attrib", "deps-only?", named="package"),
)
def export(given: argparse.Namespace, _call: Call) -> Lines:
    """Return an attribute of the exports of a package and its dependencies, on one line."""
    if not (given.lang and given.attrib):
        raise QUERIES.error("no package / lang / attrib given")

    def ask(known: Dependencies, name: str) -> list[str]:
        packages = [*([] if given.deps_only else [name]), *reversed(known.all_of(name))]
        return [" ".join(value for each in packages for value in _exported(known, each, given.lang, given.attrib))]

    return QUERIES.lines(given, ask)


def _exported(known: Dependencies, package: str, tag: str, attribute: str) -> list[str]:
    """Return the values of an attribute of the exports with this tag."""
    found = known.index.find(package)
    values = (each.get(attribute) for each in found.exports if each.tag == tag)
    return [value.replace("${prefix}", str(found.path)) for value in values if value is not None]


def _refuse(names: str, summary: str, reason: str) -> None:
    """Add verbs that only say why they are not supported."""

    def refuse(_given: argparse.Namespace, _call: Call) -> Lines:
        raise QUERIES.error(reason)

    for name in names.split():
        parser = QUERIES.parser(name, "deps-only?", named="package")
        TOOL.verb(summary, name=name, parser=parser)(refuse)


_refuse(
    COMPILING,
    "(options of a C++ compiler: not here)",
    "this gives options for a C++ compiler, which rosmini does not run; with real ROS, ask pkg-config or CMake",
)
_refuse(
    SYSTEM, "(packages of the system: not here)",
    "this asks rosdep for packages of the system, and rosmini needs none; `rosmini rospack depends` lists ROS packages",
)  # fmt: skip
_refuse(VERSION_CONTROL, "(version control of rosbuild: not here)", "this was for rosbuild's <versioncontrol>; ask git")
_refuse("langs", "(client libraries of rosbuild: not here)", "this was for rosbuild; the client library here is rospy")
