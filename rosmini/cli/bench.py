"""`rosmini bench`: the measurements of a checkout, which are not in the installed package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .checkout import find_checkout, make_importable

if TYPE_CHECKING:
    import argparse


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add the subcommand's parser. Raises `NoCheckout` outside a checkout."""
    make_importable(find_checkout() / "tests" / "benchmarks")
    import rosmini_bench

    return rosmini_bench.add_parser(subparsers)


def main(args: argparse.Namespace) -> int:
    """Measure and print."""
    import rosmini_bench

    return rosmini_bench.main(args)
