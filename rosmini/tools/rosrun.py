"""`rosmini rosrun`: a node in a process of its own, on the graph of the Master that ROS_MASTER_URI names."""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rosmini.core.verbs import dashed_remapping

from .collector import seldom
from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    from collections.abc import Sequence

USAGE = "rosmini rosrun [--prefix CMD] [--debug] PACKAGE EXECUTABLE [ARGS]"

EPILOG = """\
EXECUTABLE is a node that rosmini brings, such as rosmini_sim simulator, a script of a package on ROS_PACKAGE_PATH, or
a program: of that package, of the devel space of its workspace, or of a ROS that is installed here.

ARGS are the executable's own words, and ROS's: chatter:=/news, __name:=talker2, __ns:=/robot1, _rate:=5;
__master:=http://HOST:PORT, __ip:=ADDRESS and __hostname:=NAME go before ROS_MASTER_URI, ROS_IP and ROS_HOSTNAME.

Ctrl-C asks the node to shut down; a second one ends it at once. The exit status is the executable's.

Example:
  rosmini rosrun turtlesim turtle_teleop_key
  rosmini rosrun rospy_tutorials talker.py chatter:=/news __name:=talker2
  rosmini rosrun --prefix "nice -n 10" rosmini_sim simulator
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
    parser.add_argument("--prefix", default="", metavar="CMD", help="the words before the command: nice, gdb --args")
    parser.add_argument("-d", "--debug", action="store_true", help="say which file is run")
    parser.add_argument("package", metavar="PACKAGE")
    parser.add_argument("executable", metavar="EXECUTABLE")
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="ARGS")
    return parser


def main(args: argparse.Namespace) -> int:
    """Run the executable to its end and return its exit status."""
    from rosmini.ros.launch.executables import ROSRUN

    program = _program(args.package, args.executable)
    if args.debug:
        print(f"[rosrun] {args.package}/{args.executable} is {program or 'run by rosmini itself'}", file=sys.stderr)
    if args.prefix:
        command = (program,) if program else (*ROSRUN, args.package, args.executable)
        return _become((*shlex.split(args.prefix), *command, *args.words))
    if program:
        return _become((program, *args.words))
    return run_node(args.package, args.executable, args.words)


def run_node(package: str, executable: str, arguments: Sequence[str]) -> int:
    """Run a built-in node or a script, in this process, on the graph of the Master; return its status."""
    from rosmini.core.names import Remappings
    from rosmini.ros.net import connect
    from rosmini.ros.scripts import NodeSpec, ScriptSpec, find, run_scripts

    words = tuple(arguments)
    found = find(f"{package}/{executable}")
    if dashed := dashed_remapping(words):
        print(f"rosmini rosrun: {dashed}", file=sys.stderr)
    spec = NodeSpec(found, words) if found.path is None else ScriptSpec(str(found.path), words)
    special = Remappings.from_argv(words).special
    end_as_ctrl_c()
    with seldom(), connect(arguments=special) as graph:
        return run_scripts([spec], graph=graph, prefix=False).status


def _program(package: str, executable: str) -> str:
    """Return the path of an executable that is neither a Python script nor a built-in node; otherwise empty."""
    from rosmini.core.errors import RosminiError
    from rosmini.core.packages import PackageIndex
    from rosmini.ros.launch.executables import ROSRUN, program_of

    try:
        words = program_of(package, executable, PackageIndex(), os.environ).words
    except RosminiError:
        return ""
    return "" if words[: len(ROSRUN)] == ROSRUN else words[0]


def _become(words: Sequence[str]) -> int:
    """Replace this process by a command, if the system can; otherwise run it and return its exit status.

    Raises ``ScriptError`` if there is no such program.
    """
    from rosmini.core.errors import ScriptError

    try:
        if os.name == "posix":
            sys.stdout.flush()
            os.execvp(words[0], [Path(words[0]).name, *words[1:]])
        return subprocess.run(words, check=False).returncode
    except FileNotFoundError as error:
        raise ScriptError(f"there is no program {words[0]!r} on PATH") from error
