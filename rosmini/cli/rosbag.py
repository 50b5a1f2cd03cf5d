"""`rosmini rosbag`: the verbs of ROS's tool, with its options and its output (http://wiki.ros.org/rosbag/Commandline).

`record` and `play` are nodes: they run in wall time in a graph of their own, with the nodes that are named after a `+` as in `rosmini run`:
`rosmini rosbag record -a + rosmini_sim/simulator + drive.py`.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from rosmini.bag.options import UsageError, play_options, play_parser, record_options, record_parser
from rosmini.cli.rosbag_tools import TOOLS, Exit

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

VERBS = {
    "check": "Tell which types in a bag are other ones on this system.",
    "compress": "Compress bag files.",
    "decompress": "Decompress bag files.",
    "filter": "Copy the messages for which an expression is true.",
    "info": "Tell what is in bag files.",
    "merge": "Make one bag of several (not in ROS's own tool).",
    "play": "Publish what is in bag files, in the order of time.",
    "record": "Write what goes over topics into a bag file.",
    "reindex": "Make a new index, for a recording that did not come to its end.",
}
ELSEWHERE = ("decrypt", "encrypt", "fix")
"""Verbs of ROS's tool that are not here."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add `rosbag`; its words are read here, in the form of ROS's tool."""
    # No word is an option for argparse: they are those of ROS's tool, and so is their order.
    parser = subparsers.add_parser(
        "rosbag", help="record, play and look into bags", add_help=False, prefix_chars="\0"
    )
    parser.add_argument("words", nargs="*")
    return parser


def usage() -> str:
    """Return what the command says of itself."""
    listed = "".join(f"   {name}  \t{text}\n" for name, text in VERBS.items())
    return (
        "Usage: rosbag <subcommand> [options] [args]\n\n"
        "A bag is a file with messages, as they went over topics. rosbag records, plays, and works on bags.\n\n"
        f"Available subcommands:\n{listed}\n"
        "`rosbag <subcommand> -h` says more."
    )


def main(args: argparse.Namespace) -> int:
    """Do what the words say; the exit status is that of ROS's tool."""
    words: list[str] = args.words
    if not words or (words[0] in ("-h", "--help", "help") and len(words) == 1):
        print(usage())
        if words:
            print("\nusage: rosmini rosbag <subcommand> [options] [args]")
            raise SystemExit(0)  # as argparse ends after a help text
        return 0
    if words[0] == "help":
        words = [words[1], "-h"]
    verb, rest = words[0], words[1:]
    if verb not in VERBS:
        known = f"real ROS has it: `rosbag {verb}`" if verb in ELSEWHERE else usage()
        print(f"Unknown command: '{verb}'\n{known}", file=sys.stderr)
        return 2 if verb not in ELSEWHERE else 1
    own = rest[: rest.index("+")] if "+" in rest else rest
    try:
        if verb == "record":
            return _run(verb, record_parser().format_help, record_options, own, rest)
        if verb == "play":
            return _run(verb, play_parser().format_help, play_options, own, rest)
        return TOOLS[verb](rest)
    except UsageError as error:
        print(error, file=sys.stderr)
        return 2
    except Exit as error:
        if error.text:
            print(error.text, file=sys.stderr)
        return error.status


def _run(
    verb: str,
    help_text: Callable[[], str],
    check: Callable[[Sequence[str]], object],
    own: Sequence[str],
    rest: Sequence[str],
) -> int:
    """Run the node, with those that were given with it."""
    from rosmini.cli import run
    from rosmini.names import Remappings

    if "-h" in own or "--help" in own:
        print(help_text(), end="")
        return 0
    check(Remappings.other_arguments(list(own)))
    keys = ["--keys"] if verb == "play" and "+" not in rest and sys.stdin.isatty() else []
    words = [f"rosbag/{verb}", *keys, *rest, "--"]
    return run.main(argparse.Namespace(words=words, sim_time=False, wall_time=True, duration=None))
