"""`rosmini run`: scripts written for rospy, unmodified, and what packages have, as nodes of one graph."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.packages import PackageIndex

from .collector import seldom
from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rosmini.ros.scripts import NodeSpec, RunResult, ScriptSpec

USAGE = "rosmini run [options] NODE [args] [+ NODE [args] ...] [options]"

EXECUTABLE = re.compile(r"(?P<package>[A-Za-z][\w-]*)/(?P<executable>[^/\\]+)")

EPILOG = """\
NODE is the file of a script, or PACKAGE/EXECUTABLE: a script in a package on ROS_PACKAGE_PATH, or a node that rosmini
brings, such as rosmini_sim/simulator. These are shut down when all scripts have ended.

The options of `rosmini run` stand before the first node or at the very end. Anything else belongs to the node
before it, remappings (chatter:=/news, __name:=talker2, _rate:=5) included. If the last argument of a
script looks like an option of `rosmini run`, put a lone `--` after it: `rosmini run plot.py --duration 5 --`. For an
argument that is a plus sign, write `++`.

In simulated time everything happens as fast as the machine allows, and in the same order on each run. In wall time
one second takes a second. Ctrl-C asks the nodes to shut down; a second one ends them at once.

The exit status is that of the first node that failed, else 0.

for example: rosmini run rosmini_sim/simulator _world:=house + square.py --duration 10
"""


def positive(text: str) -> float:
    """Parse a positive number of seconds."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of seconds above zero")
    return value


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, which may be at both ends of the command line."""
    clock = parser.add_mutually_exclusive_group()
    clock.add_argument(
        "--sim-time", action="store_true", help="simulated time: as fast as possible, the same on each run"
    )
    clock.add_argument("--wall-time", action="store_true", help="wall time (the default without --duration)")
    parser.add_argument(
        "--duration",
        type=positive,
        metavar="S",
        help="end after S seconds of graph time; selects simulated time unless --wall-time is given",
    )


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add `run`."""
    parser = subparsers.add_parser(
        "run",
        help="run scripts written for rospy, and nodes by name, as nodes of one graph",
        description=__doc__,
        usage=USAGE,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_options(parser)
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="NODE [args]", help="the nodes, with + between them")
    return parser


def split_options(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Split ``words`` into the scripts with their arguments, and rosmini's options at the end."""
    end = len(words)
    if end and words[-1] == "--":
        return list(words[:-1]), []
    while end > 0:
        if words[end - 1] in ("--sim-time", "--wall-time") or words[end - 1].startswith("--duration="):
            end -= 1
        elif end > 1 and words[end - 2] == "--duration":
            end -= 2
        elif words[end - 1] == "--duration":  # its value is missing: argparse says so
            end -= 1
        else:
            break
    return list(words[:end]), list(words[end:])


def nodes_in(words: Sequence[str]) -> list[ScriptSpec | NodeSpec]:
    """Split ``words`` at the plus signs into scripts and built-in nodes, with their arguments.

    Raises `RosminiError` if one is missing, or a package or an executable is unknown.
    """
    groups: list[list[str]] = [[]]
    for word in words:
        if word == "+":
            groups.append([])
        else:
            groups[-1].append("+" if word == "++" else word)
    if groups == [[]]:
        raise RosminiError(f"no script and no node was given.\nusage: {USAGE}")
    if [] in groups:
        raise RosminiError(
            "a script or a node is missing before or after `+`; write `++` for an argument that is a plus sign"
        )
    return [spec_of(group[0], tuple(group[1:])) for group in groups]


def spec_of(name: str, args: tuple[str, ...]) -> ScriptSpec | NodeSpec:
    """Return the script or node for ``name``: an existing file, or PACKAGE/EXECUTABLE if it has that form."""
    from rosmini.ros.scripts import NodeSpec, ScriptSpec, find

    words = EXECUTABLE.fullmatch(name)
    if words is None or Path(name).exists():
        return ScriptSpec(name, args)
    if name.endswith(".py") and words["package"] not in PackageIndex():
        return ScriptSpec(name, args)  # a missing file in a folder
    found = find(name)
    return NodeSpec(found, args) if found.path is None else ScriptSpec(str(found.path), args)


def main(args: argparse.Namespace) -> int:
    """Run the scripts; the exit status is that of the first that failed."""
    words, trailing = split_options(args.words)
    if trailing:
        parser = argparse.ArgumentParser(prog="rosmini run", usage=USAGE)
        add_options(parser)
        args = parser.parse_args(trailing, argparse.Namespace(**vars(args)))
        if args.sim_time and args.wall_time:
            parser.error("--sim-time and --wall-time exclude each other")
    specs = nodes_in(words)
    from rosmini.ros.scripts import run_scripts

    end_as_ctrl_c()
    simulated = not args.wall_time and (args.sim_time or args.duration is not None)
    with seldom():
        result = run_scripts(specs, simulated=simulated, duration=args.duration)
    tell(result)
    return result.status


def tell(result: RunResult) -> None:
    """Print what the nodes were waiting for, if the run ended because no event was left."""
    report = result.report
    if result.reason == "drained" and report is not None and report.waiting:
        print(f"rosmini: {report}", file=sys.stderr)
