"""`rosmini catkin_init_workspace`: makes a folder the source space of a workspace."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `catkin_init_workspace`."""
    parser = subparsers.add_parser(
        "catkin_init_workspace",
        help="make a folder the source space of a workspace",
        description=__doc__,
        epilog="for example: mkdir -p ws/src && rosmini catkin_init_workspace ws/src",
    )
    parser.add_argument("workspace", nargs="?", default=".", help="the folder (default: the working folder)")
    return parser


def main(args: argparse.Namespace) -> int:
    """Do it; 2 if that cannot be, as the original."""
    from rosmini.catkin import CatkinError, init_workspace

    folder = Path.cwd() / args.workspace
    try:
        if not folder.is_dir():
            raise CatkinError(f'The folder "{folder}" does not exist; mkdir -p {folder}')
        print(f'Created file "{init_workspace(folder)}"')
    except (CatkinError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0
