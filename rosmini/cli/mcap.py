"""`rosmini mcap convert`: from a bag to an MCAP file, which Foxglove opens (https://mcap.dev).

The words are those of the tool of that name. Messages are not changed: only the container is another.
"""

from __future__ import annotations

import argparse
import sys


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `mcap`."""
    parser = subparsers.add_parser(
        "mcap",
        help="write a bag as an MCAP file, which Foxglove opens",
        description=__doc__,
        epilog="for example: rosmini mcap convert drive.bag drive.mcap",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    convert = verbs.add_parser("convert", help="write a bag as an MCAP file")
    convert.add_argument("bag", metavar="BAG")
    convert.add_argument("mcap", metavar="MCAP")
    return parser


def main(args: argparse.Namespace) -> int:
    """Write it; 1 if the bag cannot be read, or the file not be written."""
    from rosmini.bag import ROSBagException
    from rosmini.bag.mcap import to_mcap

    try:
        copied = to_mcap(args.bag, args.mcap)
    except (ROSBagException, OSError) as error:
        print(f"rosmini mcap: {error}", file=sys.stderr)
        return 1
    print(f"{copied.written} messages written to {args.mcap}")
    return 0
