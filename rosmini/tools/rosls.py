"""`rosmini rosls`: lists the folder of a package."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core import files
from rosmini.core.verbs import ArgumentParser, Call, Lines, Tool

from .roscd import located

if TYPE_CHECKING:
    import argparse

TOOL = Tool("rosls", "list what is in the folder of a package", needs_graph=False, only_verb="list")


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini rosls",
        "What is in the folder of a package.",
        epilog="for example: rosmini rosls turtlebot3_description/urdf",
    )
    parser.add_argument("location", nargs="?", help="PACKAGE or PACKAGE/FOLDER; by default the working folder")
    return parser


def names(path: Path) -> list[str]:
    """Return the contents of a folder like ls: sorted, without hidden files; for a file, its path."""
    return [name for name in files.names_in(path) if not name.startswith(".")] if path.is_dir() else [str(path)]


@TOOL.verb("list what is in the folder of a package", name="list", parser=_parser, takes="location")
def _list(given: argparse.Namespace, _call: Call) -> Lines:
    """List the contents."""
    return Lines(lines=tuple(names(located(given.location, "access") if given.location else Path())))
