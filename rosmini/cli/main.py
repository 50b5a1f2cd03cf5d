"""The `rosmini` command: finds the subcommand that was asked for and imports that one only.

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
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple, Protocol, cast

from rosmini import __version__
from rosmini.errors import RosminiError, nearest
from rosmini.names import ROS_RELEASE

from .checkout import find_checkout

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


class Command(Protocol):
    """What the module of a subcommand provides."""

    def add_parser(self, subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
        """Add the subcommand's parser."""

    def main(self, args: argparse.Namespace) -> int:
        """Do it; the exit status."""


class Entry(NamedTuple):
    """Where a subcommand lives, and the line that `rosmini --help` shows without importing it."""

    module: str
    summary: str
    folder: str | None = None
    """The folder of a checkout from which the module is imported; None: it is in the installed package."""
    is_magic: bool = False
    """Whether notebooks have it as a line magic, too: its module has a ``TOOL``."""
    only: str = ""
    """The verb of that tool that the subcommand stands for, if it is one verb only."""

    def load(self) -> Command:
        """Import the subcommand. Raises `NoCheckout` if it needs a checkout and there is none."""
        if self.folder is not None and (home := str(find_checkout() / self.folder)) not in sys.path:
            sys.path.insert(0, home)
        module = importlib.import_module(self.module)
        return cast("Command", vars(module)["TOOL"].alone(self.only) if self.only else module)


RQT = {
    "graph": "the computation graph",
    "plot": "numbers in messages over time",
    "topic": "topics with types, bandwidths, rates and values",
    "msg": "the fields of a message type",
    "srv": "the fields of a service type",
    "action": "the fields of an action type",
    "console": "what nodes log",
    "bag": "what is in a bag, over time",
    "tf_tree": "the tree of frames",
    "image_view": "the next image on a topic",
    "gui": "several plugins in one window",
    "robot_steering": "drive a robot, with keys",
    "publisher": "publish on topics, from a form",
    "service_caller": "call services, from a form",
    "logger_level": "how much each node logs, from a form",
    "reconfigure": "parameters of nodes that run, from a form",
}
"""The tools of rqt, each a verb of `rosmini rqt`."""

COMMANDS: dict[str, Entry] = {
    "roscore": Entry("rosmini.cli.roscore", "the Master, the Parameter Server and /rosout"),
    "rosrun": Entry("rosmini.cli.rosrun", "run a node in a process of its own, on the graph of a Master"),
    "roslaunch": Entry(
        "rosmini.cli.roslaunch", "start the nodes of launch files, and look at what they mean", is_magic=True
    ),
    "test": Entry("rosmini.cli.test", "run the tests of launch files"),
    "run": Entry("rosmini.cli.run", "run scripts written for rospy as nodes of one graph"),
    "rosnode": Entry(
        "rosmini.cli.rosnode",
        "nodes: which there are, what they do, whether they answer; end them",
        is_magic=True,
    ),
    "rostopic": Entry(
        "rosmini.cli.rostopic",
        "topics: which there are, what is published on them, how often; publish on one",
        is_magic=True,
    ),
    "rosservice": Entry(
        "rosmini.cli.rosservice",
        "services: which there are, of which types, who offers them; call one",
        is_magic=True,
    ),
    "rosmsg": Entry(
        "rosmini.cli.rosmsg", "message types: which there are, and their definitions", is_magic=True
    ),
    "rossrv": Entry(
        "rosmini.cli.rossrv", "service types: which there are, and their definitions", is_magic=True
    ),
    "roswtf": Entry(
        "rosmini.cli.roswtf", "what is probably wrong with the graph, and what to do about it", is_magic=True
    ),
    "roswhy": Entry(
        "rosmini.cli.roswhy", "why the last message on a topic came: the chain of its causes", is_magic=True
    ),
    "rossequence": Entry(
        "rosmini.cli.rossequence", "who called whom, and sent what to whom, as it happened", is_magic=True
    ),
    "fault": Entry(
        "rosmini.cli.fault",
        "make something go wrong: lose, delay or double messages, kill a node, cut a service, jump a clock",
        is_magic=True,
    ),
    "rosparam": Entry(
        "rosmini.cli.rosparam", "parameters: get, set, load, dump, delete and list them", is_magic=True
    ),
    "rqt": Entry("rosmini.cli.rqt", "the tools of rqt, as pictures", is_magic=True),
    **{
        f"rqt_{verb}": Entry("rosmini.cli.rqt", f"rqt: {summary}", is_magic=True, only=verb)
        for verb, summary in RQT.items()
    },
    "logo": Entry(
        "rosmini.cli.logo", "run a program in Logo, which drives turtles and robots", is_magic=True
    ),
    "rviz": Entry(
        "rosmini.cli.rviz", "what RViz shows: displays in a scene, and their status", is_magic=True
    ),
    "rosbag": Entry("rosmini.cli.rosbag", "record, play and look into bags", is_magic=True),
    "rospack": Entry(
        "rosmini.cli.rospack", "packages: where they are, what they need, what they export", is_magic=True
    ),
    "rosstack": Entry(
        "rosmini.cli.rosstack", "stacks and metapackages: where they are, what is in them", is_magic=True
    ),
    "roscd": Entry("rosmini.cli.roscd", "go to the folder of a package", is_magic=True),
    "rosls": Entry("rosmini.cli.rosls", "list what is in the folder of a package", is_magic=True),
    "rosversion": Entry("rosmini.cli.rosversion", "the version of a package", is_magic=True),
    "aliases": Entry("rosmini.cli.aliases", "lines for a shell: bare names (rostopic ...) and completion"),
    "catkin_init_workspace": Entry(
        "rosmini.cli.catkin_init_workspace", "make a folder the source space of a workspace", is_magic=True
    ),
    "catkin_create_pkg": Entry("rosmini.cli.catkin_create_pkg", "make a new package", is_magic=True),
    "catkin_make": Entry("rosmini.cli.catkin_make", "build a catkin workspace", is_magic=True),
    "stubs": Entry("rosmini.cli.stubs", "write type stubs of rospy and of messages, for editors"),
    "mcap": Entry("rosmini.cli.mcap", "write a bag as an MCAP file, which Foxglove opens, or back"),
    "gz": Entry("rosmini.cli.gz", "Gazebo's own tool: topics, models, time, SDF files"),
    "world": Entry("rosmini.cli.world", "list worlds, and check files of worlds, maps and robots"),
    "book": Entry("book.tools.book", "build the book from the stored outputs and open it", "."),
    "lab": Entry("book.tools.lab", "open the notebooks in JupyterLab", "."),
    "bench": Entry(
        "rosmini_bench",
        "measure rosmini, beside real ROS and ir-sim where they are installed",
        "tests/benchmarks",
    ),
}


NO_COMMANDS = {
    "roscpp": "that is the library for nodes in C++; `rosnode` lists nodes, tells about them and ends them",
    "rospy": "that is the library for nodes in Python; `rosrun PACKAGE SCRIPT` starts a script that imports it",
    "rosmake": "packages are built by `catkin_make`",
    "roscreate-pkg": "packages are created by `catkin_create_pkg`",
}
"""What is taken for a command, or was one, and what to write."""


def chosen(argv: Sequence[str]) -> str | None:
    """The subcommand that `argv` names: its first word that is not an option; None if there is no such word.

    Raises `RosminiError` if that word is no subcommand.
    """
    words = [word for word in argv if not word.startswith("-")]
    if not words or words[0] in COMMANDS:
        return words[0] if words else None
    word, *rest = words
    guess = NO_COMMANDS.get(word) or nearest(word, COMMANDS)
    if rest and f"ros{rest[0]}" in COMMANDS:  # `rostop node list`
        guess = f"did you mean `{' '.join(['ros' + rest[0], *rest[1:]])}`?"
    raise RosminiError(f"there is no command {word!r}; {guess or 'the commands are: ' + ', '.join(COMMANDS)}")


def build_parser(loaded: dict[str, Command], *, others: bool = True) -> argparse.ArgumentParser:
    """The parser: in full for the `loaded` subcommands, and with ``others`` by name and summary for all that is left.

    A tool that starts needs no others, and sixty of them take longer to make than its questions to be answered.
    """
    parser = argparse.ArgumentParser(
        prog="rosmini",
        description="ROS 1 that you can read, run and test.",
        epilog="`rosmini COMMAND --help` says more about a command.",
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    subparsers = parser.add_subparsers(dest="command", metavar="COMMAND", title="commands")
    for name, entry in COMMANDS.items():
        if name in loaded:
            loaded[name].add_parser(subparsers)
        elif others:
            subparsers.add_parser(name, help=entry.summary, add_help=False)
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run `rosmini` with `argv` (default: the command line) and return its exit status.

    0 is success, 1 a failure that was reported, 2 a command line that makes no sense, 130 Ctrl-C.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a message's letter that the locale lacks ends no command
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
            parser.print_help()
            return 2
        status = loaded[name].main(args)
        sys.stdout.flush()
        return status
    except RosminiError as error:
        print(f"rosmini {name}: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        return _cannot_write(error, name)
    except KeyboardInterrupt:
        print(file=sys.stderr)
        return 130


def _cannot_write(error: OSError, name: str | None) -> int:
    """Return the exit status where the output goes nowhere: to what has had enough, such as `head`, or a full disk.

    Raises any other error again.
    """
    if not isinstance(error, BrokenPipeError) and error.errno != errno.ENOSPC:
        raise error
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left of the output is not wanted
    if isinstance(error, BrokenPipeError):
        return 0
    print(f"rosmini {name}: the output cannot be written: {error.strerror}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
