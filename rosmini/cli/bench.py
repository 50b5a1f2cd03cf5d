"""`rosmini bench`: the measurements of a checkout, which are no part of the installed package."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import TYPE_CHECKING, cast

from rosmini.errors import RosminiError

if TYPE_CHECKING:
    import argparse

    from .main import Command

HOME = Path(__file__).resolve().parents[2] / "tests" / "benchmarks"


def _measurements() -> Command:
    if not (HOME / "rosmini_bench").is_dir():
        raise RosminiError(
            "the benchmarks are no part of the installed package: clone the repository, and run "
            "`uv run rosmini bench` inside the clone"
        )
    if str(HOME) not in sys.path:
        sys.path.append(str(HOME))
    return cast("Command", importlib.import_module("rosmini_bench"))


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add the subcommand's parser. Raises `RosminiError` outside a checkout."""
    return _measurements().add_parser(subparsers)


def main(args: argparse.Namespace) -> int:
    """Measure and print."""
    return _measurements().main(args)
