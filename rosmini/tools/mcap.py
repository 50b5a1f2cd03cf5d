"""`rosmini mcap convert`: from a bag to an MCAP file, which Foxglove opens, or back (https://mcap.dev).

The words are those of the tool of that name. Messages are not changed: only the container is another.
"""

from __future__ import annotations

import argparse
import sys


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `mcap`."""
    parser = subparsers.add_parser(
        "mcap",
        help="write a bag as an MCAP file, which Foxglove opens, or an MCAP file as a bag",
        description=__doc__,
        epilog="for example: rosmini mcap convert drive.bag drive.mcap",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    convert = verbs.add_parser("convert", help="write a bag as an MCAP file, or an MCAP file as a bag")
    convert.add_argument("source", metavar="FROM", help="a .bag or an .mcap")
    convert.add_argument("target", metavar="TO", help="the file of the other kind")
    return parser


def main(args: argparse.Namespace) -> int:
    """Write the file; return 1 if the bag cannot be read or the file cannot be written."""
    from rosmini.ros.bag import ROSBagException
    from rosmini.ros.bag.mcap import from_mcap, to_mcap

    try:
        convert = from_mcap if args.source.endswith(".mcap") else to_mcap
        copied = convert(args.source, args.target)
    except (ROSBagException, OSError) as error:
        print(f"rosmini mcap: {error}", file=sys.stderr)
        return 1
    print(f"{copied.written} messages written to {args.target}")
    return 0
