"""The `rosmini` command: finds the requested subcommand and imports only that one.

A subcommand is a module with `add_parser(subparsers)`, which adds its own parser, and `main(args) -> int`,
which does the work and returns the exit status.
"""

from __future__ import annotations

import argparse
import errno
import importlib
import io
import os
import sys
import textwrap
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from operator import attrgetter
from typing import TYPE_CHECKING, Protocol, cast

from rosmini import __version__
from rosmini.core.entry_points import entry_points
from rosmini.core.errors import RosminiError, UsageError, nearest
from rosmini.core.names import ROS_RELEASE, is_remapping
from rosmini.core.verbs import Tool

from .checkout import find_checkout
from .terminal import Terminal

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from types import ModuleType


class Command(Protocol):
    """Interface of a subcommand's module."""

    def add_parser(self, subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
        """Add the subcommand's parser."""

    def main(self, args: argparse.Namespace) -> int:
        """Run the subcommand and return the exit status."""


ROS, OWN, BUILD, BOOK = "ROS's own commands", "Run and look", "Packages", "The book"
"""Headings of `rosmini --help`."""

WELCOME = """\
Learn ROS by driving a robot.

  rosmini lab                                       the chapters, in JupyterLab
  rosmini run talker.py + listener.py               your own rospy scripts
  rosmini roslaunch rosmini_sim navigation.launch   a robot that finds its way;
  rosmini rviz                                      then click a goal for it

`rosmini --help` lists all commands."""
"""Text that `rosmini` prints without arguments."""


@dataclass(frozen=True)
class Entry:
    """Location of a subcommand, and the line for `rosmini --help`, which is shown without importing it."""

    module: str
    summary: str
    folder: str | None = None
    """Folder of a checkout from which the module is imported; None: it is in the installed package."""
    is_magic: bool = False
    """True if notebooks also have it as a line magic: its module has a ``TOOL``."""
    group: str = ROS
    """Heading under which `rosmini --help` lists it."""

    def load(self) -> Command:
        """Import the subcommand. Raises `NoCheckout` if it needs a checkout and there is none."""
        if self.folder is not None and (home := str(find_checkout() / self.folder)) not in sys.path:
            sys.path.insert(0, home)
        return _command(importlib.import_module(self.module))

    def tool(self) -> Tool | None:
        """Return the tool of the subcommand, if it has one. Raises as `load`."""
        self.load()
        found = vars(sys.modules[self.module]).get("TOOL")
        return found if isinstance(found, Tool) else None


@dataclass(frozen=True)
class Plugged:
    """A subcommand from another room or distribution: a `Tool` that is imported on first use."""

    entry_point: EntryPoint

    def tool(self) -> Tool:
        """Import the tool. Raises the errors of its module."""
        found: Tool = self.entry_point.load()
        only = self.entry_point.name.removeprefix(f"{found.name}_")
        return found.alone(only) if only in found.verbs else found

    def load(self) -> Command:
        """Import the subcommand."""
        return Terminal(self.tool())

    @property
    def summary(self) -> str:
        """Line for `rosmini --help`."""
        return self.tool().summary

    @property
    def is_magic(self) -> bool:
        """True if notebooks also have it as a line magic."""
        return self.tool().is_magic

    @property
    def group(self) -> str:
        """Heading under which `rosmini --help` lists it."""
        return self.tool().group or ROS

    @property
    def folder(self) -> None:
        """None: the tool is in an installed package."""


def _command(module: ModuleType) -> Command:
    """Return the subcommand of a module: its tool, or the module itself."""
    tool = vars(module).get("TOOL")
    return cast("Command", module) if tool is None or "main" in vars(module) else Terminal(tool)


COMMANDS: dict[str, Entry | Plugged] = {
    "roscore": Entry("rosmini.tools.roscore", "start the Master, the Parameter Server and /rosout"),
    "rosrun": Entry("rosmini.tools.rosrun", "run a node in a process of its own"),
    "roslaunch": Entry(
        "rosmini.tools.roslaunch", "start the nodes of launch files, or show what the files mean", is_magic=True
    ),
    "test": Entry("rosmini.tools.test", "run the tests in launch files", group=OWN),
    "run": Entry("rosmini.tools.run", "run rospy scripts as nodes of one graph, also faster than real time", group=OWN),
    "rosnode": Entry("rosmini.tools.rosnode", "list, describe, ping and end nodes", is_magic=True),
    "rostopic": Entry(
        "rosmini.tools.rostopic", "list topics, print and publish messages, measure rates", is_magic=True
    ),
    "rosservice": Entry("rosmini.tools.rosservice", "list, describe and call services", is_magic=True),
    "rosmsg": Entry("rosmini.tools.rosmsg", "show message types", is_magic=True),
    "rossrv": Entry("rosmini.tools.rossrv", "show service types", is_magic=True),
    "roswtf": Entry(
        "rosmini.tools.roswtf", "find probable mistakes in the graph, and say how to fix them", is_magic=True
    ),
    "roswhy": Entry(
        "rosmini.tools.roswhy", "explain why the last message on a topic was sent", is_magic=True, group=OWN
    ),
    "rossequence": Entry(
        "rosmini.tools.rossequence", "show who called whom and who sent what to whom", is_magic=True, group=OWN
    ),
    "fault": Entry(
        "rosmini.tools.fault",
        "cause a fault: lost, late or repeated messages, a dead node, a clock that jumps",
        is_magic=True,
        group=OWN,
    ),
    "rosparam": Entry("rosmini.tools.rosparam", "get, set, load, dump, delete and list parameters", is_magic=True),
    "rosbag": Entry("rosmini.tools.rosbag", "record, play and inspect bags", is_magic=True),
    "rospack": Entry(
        "rosmini.tools.rospack", "find packages, and list what they depend on and export", is_magic=True, group=BUILD
    ),
    "rosstack": Entry(
        "rosmini.tools.rosstack", "find stacks and metapackages, and list their contents", is_magic=True, group=BUILD
    ),
    "roscd": Entry("rosmini.tools.roscd", "go to the folder of a package", is_magic=True, group=BUILD),
    "rosls": Entry("rosmini.tools.rosls", "list the folder of a package", is_magic=True, group=BUILD),
    "rosversion": Entry("rosmini.tools.rosversion", "print the version of a package", is_magic=True, group=BUILD),
    "aliases": Entry(
        "rosmini.tools.aliases", "print shell lines that define the bare names (rostopic ...) and completion", group=OWN
    ),
    "catkin_init_workspace": Entry(
        "rosmini.tools.catkin_init_workspace",
        "make a folder the source space of a workspace",
        is_magic=True,
        group=BUILD,
    ),
    "catkin_create_pkg": Entry("rosmini.tools.catkin_create_pkg", "create a package", is_magic=True, group=BUILD),
    "catkin_make": Entry("rosmini.tools.catkin_make", "build a workspace", is_magic=True, group=BUILD),
    "stubs": Entry("rosmini.tools.stubs", "write type stubs of rospy and of messages for editors", group=OWN),
    "mcap": Entry("rosmini.tools.mcap", "convert between bags and MCAP files, which Foxglove opens", group=OWN),
    "book": Entry("book.tools.book", "build this book and open it", ".", group=BOOK),
    "lab": Entry("book.tools.lab", "open the chapters in JupyterLab", ".", group=BOOK),
    "assignment": Entry("book.tools.assignment", "write a notebook with chosen exercises", ".", group=BOOK),
    "bench": Entry(
        "rosmini_bench", "measure rosmini beside real ROS and other simulators", "tests/benchmarks", group=BOOK
    ),
}
COMMANDS.update((found.name, Plugged(found)) for found in sorted(entry_points("rosmini.verbs"), key=attrgetter("name")))


NO_COMMANDS = {
    "roscpp": "that is the library for nodes in C++; `rosnode` lists nodes, tells about them and ends them",
    "rospy": "that is the library for nodes in Python; `rosrun PACKAGE SCRIPT` starts a script that imports it",
    "rosmake": "packages are built by `catkin_make`",
    "roscreate-pkg": "packages are created by `catkin_create_pkg`",
}
"""Words mistaken for commands, and former commands, with the replacements."""


def chosen(argv: Sequence[str]) -> str | None:
    """Return the subcommand in `argv`: the first word that is not an option, or None.

    Raises `RosminiError` if that word is not a subcommand.
    """
    words = [word for word in argv if not word.startswith("-")]
    if not words or words[0] in COMMANDS:
        return words[0] if words else None
    word, *rest = words
    guess = NO_COMMANDS.get(word) or nearest(word, COMMANDS)
    if rest and f"ros{rest[0]}" in COMMANDS:  # `rostop node list`
        guess = f"did you mean `{' '.join(['ros' + rest[0], *rest[1:]])}`?"
    raise RosminiError(f"there is no command {word!r}; {guess or '`rosmini --help` lists all commands'}")


def in_script(name: str, words: Sequence[str]) -> int:
    """Run a tool with some words on the graph that runs the caller, print the output, and return the exit status.

    ``rosbag.rosbagmain`` and ``rosparam.yamlmain`` find this through the entry point `rosmini.tools`.
    """
    tool = COMMANDS[name].tool()
    if tool is None:
        raise UsageError(f"{name} is not a tool that a script can run")
    return Terminal(tool).reported(lambda: tool.run(*(word for word in words if not is_remapping(word))))


def build_parser(loaded: dict[str, Command], *, others: bool = True) -> argparse.ArgumentParser:
    """Return the parser with the options of the `loaded` subcommands and, with ``others``, the names of all others.

    A tool that starts does not need the others: creating sixty parsers takes longer than the tool's work.
    """
    parser = argparse.ArgumentParser(
        prog="rosmini",
        usage="rosmini COMMAND ..." if others else None,
        description="ROS 1 that you can read, run and test.",
        epilog=grouped_commands() if others else None,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    subparsers = parser.add_subparsers(dest="command", metavar="COMMAND", help=argparse.SUPPRESS)
    for name in COMMANDS:
        if name in loaded:
            loaded[name].add_parser(subparsers)
        elif others:
            subparsers.add_parser(name, add_help=False)
    return parser


def grouped_commands() -> str:
    """Return the commands with their summaries, under headings; the tools of rqt share one line."""
    lines = []
    for group in (ROS, OWN, BUILD, BOOK):
        lines.append(f"{group}:")
        shown = {name: entry.summary for name, entry in COMMANDS.items() if entry.group == group}
        tools = [name for name in shown if name.startswith("rqt_")]
        width = max(len(name) for name in shown if name not in tools)
        for name, summary in shown.items():
            if name not in tools:
                lines.append(f"  {name:{width}}  {summary}")
            if name == "rqt":
                lines += textwrap.wrap(", ".join(tools), 78, initial_indent=" " * 4, subsequent_indent=" " * 4)
        lines.append("")
    return "\n".join([*lines, "`rosmini COMMAND --help` says more about a command."])


def main(argv: Sequence[str] | None = None) -> int:
    """Run `rosmini` with `argv` (default: the command line) and return its exit status.

    0 is success, 1 a reported failure, 2 an invalid command line, 130 Ctrl-C.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a character missing in the locale must not end a command
            stream.reconfigure(errors="backslashreplace")
    argv = sys.argv[1:] if argv is None else list(argv)
    try:
        name = chosen(argv)
    except RosminiError as error:
        print(f"rosmini: {error}", file=sys.stderr)
        return 2
    with _ros_release():
        return _run(name, argv)


@contextmanager
def _ros_release() -> Iterator[None]:
    """Set the environment variables that name the ROS release, as a setup file of ROS does."""
    missing = ROS_RELEASE.keys() - os.environ.keys()
    os.environ.update({variable: ROS_RELEASE[variable] for variable in missing})
    try:
        yield
    finally:
        for variable in missing:
            os.environ.pop(variable, None)


def _run(name: str | None, argv: list[str]) -> int:
    """Run a subcommand and return its exit status; errors are reported."""
    try:
        loaded = {name: COMMANDS[name].load()} if name else {}
        parser = build_parser(loaded, others=argv[:1] != [name])
        args = parser.parse_args(argv)
        if args.version:
            print(f"rosmini {__version__}")
            return 0
        if name is None:
            print(WELCOME)
            return 2
        status = loaded[name].main(args)
        sys.stdout.flush()
        return status
    except RosminiError as error:
        print(f"rosmini {name}: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        return _system_refused(error, name)
    except KeyboardInterrupt:
        print(file=sys.stderr)
        return 130


def _system_refused(error: OSError, name: str | None) -> int:
    """Report an operating system error with a simple cause and return the exit status.

    Such causes are a file that cannot be opened, a closed reader of the output (`head`), and a full disk.
    Any other error is raised again.
    """
    if error.filename is not None:
        print(f"rosmini {name}: cannot open {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    if not isinstance(error, BrokenPipeError) and error.errno != errno.ENOSPC:
        raise error
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # discard the remaining output
    if isinstance(error, BrokenPipeError):
        return 0
    print(f"rosmini {name}: the output cannot be written: {error.strerror}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
