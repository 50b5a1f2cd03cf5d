"""`rosmini rosrun`: a node in a process of its own, on the graph of the Master that ROS_MASTER_URI names."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from .arguments import dashed_remapping
from .collector import seldom
from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from collections.abc import Sequence

USAGE = "rosmini rosrun PACKAGE EXECUTABLE [ARGS]"

EPILOG = """\
EXECUTABLE is a node that rosmini brings, such as rosmini_sim simulator, a script of a package on ROS_PACKAGE_PATH, or
a program: of that package, of the devel space of its workspace, or of a ROS that is installed here.

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

    words = tuple(args.words)
    program = _program(args.package, args.executable)
    if program:
        return _become(program, words)
    found = find(f"{args.package}/{args.executable}")
    if dashed := dashed_remapping(words):
        print(f"rosmini rosrun: {dashed}", file=sys.stderr)
    spec = NodeSpec(found, words) if found.path is None else ScriptSpec(str(found.path), words)
    special = Remappings.from_argv(words).special
    end_as_ctrl_c()
    with seldom(), connect(arguments=special) as graph:
        return run_scripts([spec], graph=graph, prefix=False).status


def _program(package: str, executable: str) -> str:
    """Return the path of what is no Python script and no built-in node; empty if it is one, or is not there."""
    from rosmini.errors import RosminiError
    from rosmini.launch.executables import ROSRUN, program_of
    from rosmini.packages import PackageIndex

    try:
        words = program_of(package, executable, PackageIndex(), os.environ).words
    except RosminiError:
        return ""
    return "" if words[: len(ROSRUN)] == ROSRUN else words[0]


def _become(program: str, words: Sequence[str]) -> int:
    """Run a program in place of this process, where the system can; else beside it, with its exit status."""
    if os.name == "posix":
        sys.stdout.flush()
        os.execv(program, [Path(program).name, *words])
    return subprocess.run([program, *words], check=False).returncode
