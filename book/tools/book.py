"""`rosmini book`: build the book and open it."""

from __future__ import annotations

import argparse
import webbrowser
from pathlib import Path

from rosmini.tools.checkout import find_checkout

from .build import build_book, has_display


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the parser of `rosmini book`."""
    parser = subparsers.add_parser(
        "book",
        help="build the book from the stored outputs and open it",
        description="Build the book as static HTML in book/_build/html, from the stored outputs, and open it.",
    )
    parser.add_argument("--no-open", action="store_true", help="only build it, and print where it is")
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="write FOLDER/_build/html instead")
    parser.add_argument("--verbose", action="store_true", help="show what Jupyter Book says")


def main(args: argparse.Namespace) -> int:
    """Build, print where the first page is, and open it unless told not to or nobody would see it."""
    checkout = find_checkout()
    print(f"Building the book in {checkout} ...", flush=True)
    output = args.output.resolve() if args.output else None
    first = build_book(checkout, output, quiet=not args.verbose)
    print(f"The book is at {first}")
    if args.no_open:
        return 0
    if not has_display():
        print("No display here: open that file in a browser.")
    elif not webbrowser.open(first.as_uri()):
        print("No browser was found: open that file yourself.")
    return 0
