"""`rosmini catkin_init_workspace`: makes a folder the source space of a workspace."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.verbs import ArgumentParser, Call, Result, Tool, VerbError, below_here

if TYPE_CHECKING:
    import argparse

TOOL = Tool(
    "catkin_init_workspace", "make a folder the source space of a workspace", needs_graph=False, only_verb="init"
)  # fmt: skip


def _parser() -> ArgumentParser:
    parser = ArgumentParser(
        "rosmini catkin_init_workspace",
        "Make a folder the source space of a workspace.",
        epilog="for example: mkdir -p ws/src && rosmini catkin_init_workspace ws/src",
    )
    parser.add_argument("workspace", nargs="?", default=".", help="the folder (default: the working folder)")
    return parser


@TOOL.verb("make a folder the source space of a workspace", parser=_parser)
def init(given: argparse.Namespace, call: Call) -> Result:
    """Make the folder a source space. Raises ``VerbError`` with the original's status on failure."""
    from rosmini.ros.catkin import CatkinError, init_workspace

    folder = Path.cwd() / given.workspace
    try:
        if not folder.is_dir():
            raise CatkinError(f'The folder "{folder}" does not exist; mkdir -p {folder}')
        below_here(call)(f'Created file "{init_workspace(folder)}"')
    except (CatkinError, OSError) as error:
        raise VerbError(str(error), 2) from error
    return Result()
