"""`rosmini gz`: the verbs of Gazebo's own tool (http://classic.gazebosim.org/tutorials?tut=components).

`sdf` works on files. The others act on a running server, which is named after a `+`, as in `rosmini run`, and runs in the same process:
`rosmini gz topic -l + gazebo_ros/gzserver worlds/empty.world`. In a notebook `rosmini.sim.gazebo.Gz` does the same on a server that runs there.
"""

from __future__ import annotations

import argparse
import sys

from rosmini.sim.gazebo.errors import GazeboError
from rosmini.sim.gazebo.gz import Gz, UsageError, parser

SETTLE_S = 0.1
"""How long the server runs before the verb acts [s]."""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add `gz`; its words are read by `Gz`, in the form of Gazebo's tool."""
    parser = subparsers.add_parser("gz", help="Gazebo's own tool", add_help=False, prefix_chars="\0")
    parser.add_argument("words", nargs="*")
    return parser


def main(args: argparse.Namespace) -> int:
    """Do what the words say; the exit status is 255 for what failed, as Gazebo's is."""
    words: list[str] = args.words
    if words and words[0] in ("-h", "--help"):
        print("\n".join(Gz().run("help")))
        print("\nusage: rosmini gz <command> [options] [+ node...]")
        raise SystemExit(0)  # as argparse ends after a help text
    own, nodes = words, []
    if "+" in words:
        own, nodes = words[: words.index("+")], words[words.index("+") + 1 :]
    try:
        if nodes:
            return _on_server(own, nodes)
        helps = {"-h", "--help"} & set(own)
        if own and own[0] in ("topic", "model", "world", "stats") and not helps:
            parser(own[0]).parse_args(own[1:])
            raise GazeboError(
                "an instance of Gazebo is not running in this process: name it after a +, for example "
                f"`rosmini gz {' '.join(own)} + gazebo_ros/gzserver worlds/empty.world`"
            )
        Gz()(*own)
    except UsageError as error:
        print(error, file=sys.stderr)
        return 255
    return 0


def _on_server(own: list[str], nodes: list[str]) -> int:
    """Start what stands after a `+`, and act on it."""
    from rosmini import Graph
    from rosmini.scripts import rosrun

    with Graph() as graph:
        while nodes:
            end = nodes.index("+") if "+" in nodes else len(nodes)
            name, *words = nodes[:end]
            nodes = nodes[end + 1 :]
            package, _, executable = name.partition("/")
            rosrun(package, executable, *words, graph=graph)
        graph.run(SETTLE_S)
        Gz(graph)(*own)
    return 0
