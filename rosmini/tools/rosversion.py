"""`rosmini rosversion`: prints the version of a package, or the name of the distribution."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from rosmini.core.errors import UnknownPackage, nearest
from rosmini.core.packages import PackageIndex
from rosmini.core.verbs import ArgumentParser, Call, Lines, Tool

if TYPE_CHECKING:
    import argparse

DISTRIBUTION = "noetic"
"""Default of ROS_DISTRO: the ROS distribution that rosmini follows."""

TOOL = Tool("rosversion", "the version of a package", needs_graph=False, only_verb="version")


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini rosversion",
        "The version of a package, or the name of the distribution.",
        epilog="for example: rosmini rosversion std_msgs",
    )
    parser.add_argument("-s", "--skip-newline", action="store_true", help="end without a newline")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("package", nargs="?", help="the name of a package")
    what.add_argument("-d", "--distro", action="store_true", help="the name of the distribution")
    return parser


def version(package: str, index: PackageIndex) -> str:
    """Return the version of a package. Raises `UnknownPackage`."""
    return index.find(package).version or "<unversioned>"


@TOOL.verb("the version of a package", name="version", parser=_parser, takes="location")
def _version(given: argparse.Namespace, _call: Call) -> Lines:
    """Return the version; the status is 1 if there is no such package."""
    end = "" if given.skip_newline else "\n"
    if given.distro:
        return Lines(lines=(os.environ.get("ROS_DISTRO") or DISTRIBUTION,), end=end)
    index = PackageIndex()
    try:
        return Lines(lines=(version(given.package, index),), end=end)
    except UnknownPackage:
        hint = nearest(given.package, index.names())
        return Lines(lines=(f"Cannot locate [{given.package}]",), complaints=(hint,) if hint else (), status=1)
