"""`rosmini rosrun`: a node in a process of its own, on the graph of the Master that ROS_MASTER_URI names."""

from __future__ import annotations

import argparse
import sys

from .arguments import dashed_remapping
from .collector import seldom
from .signals import end_as_ctrl_c

USAGE = "rosmini rosrun PACKAGE EXECUTABLE [ARGS]"

EPILOG = """\
EXECUTABLE is a node that rosmini brings, such as rosmini_sim simulator, or a script of a package on ROS_PACKAGE_PATH.

ARGS are the executable's own words, and ROS's: chatter:=/news, __name:=talker2, __ns:=/robot1, _rate:=5;
__master:=http://HOST:PORT, __ip:=ADDRESS and __hostname:=NAME go before ROS_MASTER_URI, ROS_IP and ROS_HOSTNAME.

Ctrl-C asks the node to shut down; a second one ends it at once. The exit status is the executable's.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `rosrun`."""
    parser = subparsers.add_parser(
        "rosrun",
        help="run a node in a process of its own, on the graph of a Master",
        description=__doc__,
        usage=USAGE,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("package", metavar="PACKAGE")
    parser.add_argument("executable", metavar="EXECUTABLE")
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="ARGS")
    return parser


def main(args: argparse.Namespace) -> int:
    """Run it to its end; the exit status is its own."""
    from rosmini.names import Remappings
    from rosmini.net import connect
    from rosmini.scripts import NodeSpec, ScriptSpec, find, run_scripts

    found = find(f"{args.package}/{args.executable}")
    words = tuple(args.words)
    if dashed := dashed_remapping(words):
        print(f"rosmini rosrun: {dashed}", file=sys.stderr)
    spec = NodeSpec(found, words) if found.path is None else ScriptSpec(str(found.path), words)
    special = Remappings.from_argv(words).special
    end_as_ctrl_c()
    with seldom(), connect(arguments=special) as graph:
        return run_scripts([spec], graph=graph, prefix=False).status
