"""`rosmini rosls`: what is in the folder of a package."""

from __future__ import annotations

import argparse
from pathlib import Path

from rosmini import files

from .roscd import located


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `rosls`."""
    parser = subparsers.add_parser(
        "rosls",
        help="list what is in the folder of a package",
        description=__doc__,
        epilog="for example: rosmini rosls turtlebot3_description/urdf",
    )
    parser.add_argument(
        "location", nargs="?", help="PACKAGE or PACKAGE/FOLDER; by default the working folder"
    )
    return parser


def names(path: Path) -> list[str]:
    """What is in a folder, as ls lists it: sorted, hidden files left out; of a file, its path."""
    return (
        [name for name in files.names_in(path) if not name.startswith(".")] if path.is_dir() else [str(path)]
    )


def main(args: argparse.Namespace) -> int:
    """Print it."""
    found = names(located(args.location, "access") if args.location else Path())
    print("\n".join(found), end="\n" if found else "")
    return 0
