"""`rosmini roslaunch`: launch files (http://wiki.ros.org/roslaunch/Commandline%20Tools)."""

from __future__ import annotations

import os
import socket
import sys
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from rosmini.core.errors import UsageError
from rosmini.core.names import is_remapping
from rosmini.core.packages import PackageIndex
from rosmini.core.verbs import Call, Lines, Parser, Result, Tool, dashed_remapping

from .collector import seldom
from .run import nodes_in, tell
from .signals import end_as_ctrl_c

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence
    from optparse import Values

    from rosmini.ros.launch import Launch, Missing, Plan

USAGE = (
    "%prog [options] [package] <filename> [arg_name:=value...]\n"
    "       %prog [options] <filename> [<filename>...] [arg_name:=value...]\n"
    "       %prog [package] <filename> [arg_name:=value...] [+ SCRIPT [args]] --one-process [--sim-time] "
    "[--duration S]\n\n"
    "If <filename> is a single dash ('-'), launch XML is read from standard input."
)

EXAMPLE = """\
  rosmini roslaunch turtlebot3_gazebo turtlebot3_world.launch model:=burger
  rosmini roslaunch --nodes turtlebot3_gazebo turtlebot3_world.launch
  rosmini roslaunch turtlebot3_gazebo turtlebot3_world.launch + drive.py --one-process --duration 30"""

DESCRIPTION = (
    "Set the parameters and start the nodes of launch files: each in a process of its own, or with --one-process all "
    "of them in one, in simulated time if you like. Ctrl-C ends them."
)

ASKING = ("node_args", "node_list", "ros_args", "dump_params", "file_list", "check")
"""Options that only query and launch nothing."""


class LaunchParser(Parser):
    """The options, with a hint if an executable was meant, as in `roslaunch map_server map_saver`."""

    def parse(self, words: Sequence[str], /) -> Values:
        """Return the given options. Raises ``UsageError``."""
        if dashed := dashed_remapping(words):
            self.error(dashed)
        try:
            return super().parse(words)
        except UsageError as error:
            if len(words) > 1 and not words[0].startswith("-") and not {"-", "."} & set(words[1]):
                raise UsageError(f"{error}\nIf an executable was meant: rosrun {' '.join(words)}") from error
            raise


def parser() -> LaunchParser:
    """Return the parser: roslaunch's options, and those for one process."""
    made = LaunchParser("roslaunch", USAGE, DESCRIPTION, example=EXAMPLE)
    made.flag("--files", dest="file_list", help="print the files that are read")
    made.add_option("--args", dest="node_args", metavar="NODE_NAME", help="print the command line of a node")
    made.flag("--nodes", dest="node_list", help="print the names of all nodes")
    made.flag("--dump-params", dest="dump_params", help="print all parameters as YAML")
    made.flag("--ros-args", dest="ros_args", help="print the arguments of the launch file")
    made.flag("--check", help="read everything, and name all that is missing (not in ROS)")
    made.flag("--screen", dest="force_screen", help="output of all nodes to the screen")
    made.flag("--log", dest="force_log", help="output of all nodes to log files")
    made.flag("--wait", dest="wait_for_master", help="wait for a Master; do not start one")
    made.flag("--skip-log-check", "--disable-title", "-v", dest="ignored", help="accepted, and without effect here")
    made.add_option("-p", "--port", help="port of the Master, if one is started", metavar="PORT")
    for name, default in (("sigint", 15.0), ("sigterm", 2.0)):
        made.add_option(
            f"--{name}-timeout", type="float", default=default, metavar="S",
            help=f"how long to wait after {name.upper()} when nodes are ended",
        )  # fmt: skip
    made.add_option("-t", "--timeout", metavar="S", help="accepted, and without effect here")
    made.flag("--one-process", help="run all nodes in this process, in a graph of its own (not in ROS)")
    made.flag("--sim-time", help="with --one-process: simulated time, as fast as possible")
    made.flag("--wall-time", help="with --one-process: wall time, also with --duration")
    made.add_option(
        "--duration", type="float", metavar="S", help="with --one-process: end after S seconds; simulated time"
    )
    return made


TOOL = Tool(
    "roslaunch", "start the nodes of launch files, and look at what they mean", only_verb="launch",
    example="turtlebot3_gazebo turtlebot3_world.launch",
)  # fmt: skip
"""The magic for notebooks: ``%roslaunch`` starts the nodes in the graph, and returns at once or after --duration."""


@dataclass(frozen=True, kw_only=True)
class Launched(Result):
    """A running launch: ``launch["talker"]`` is a node's handle, ``launch.stop()`` ends all nodes."""

    launch: Launch


@TOOL.verb("start the nodes of launch files", parser=parser, name="launch", takes="launch")
def _launch_here(given: Values, call: Call) -> Result:
    from rosmini.ros.launch.running import Launch, differences, in_graph

    packages = PackageIndex()
    plan = plan_of(given, packages, None)
    if is_question(given):
        return answer(given, plan, packages)
    plan = changed(plan, given)
    plan.warnings += differences(plan)
    make = in_graph(call.graph, packages, to_log=bool(given.force_log), **call.console)
    launch = Launch(plan, call.graph, make, say=call.say, warn=call.say)
    launch.start()
    if given.duration is not None:
        launch.wait(given.duration)
    return Launched(launch=launch)


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> object:
    """Add `roslaunch`."""
    import argparse

    added = subparsers.add_parser("roslaunch", help=DESCRIPTION, add_help=False, prefix_chars="\0")
    added.add_argument("words", nargs=argparse.REMAINDER)
    return added


def main(args: argparse.Namespace) -> int:
    """Launch, or answer a query; the exit status is 1 for an invalid launch file."""
    words: list[str] = list(args.words)
    if {"-h", "--help"} & set(words):
        print(parser().format_help().replace("Usage: roslaunch", "usage: rosmini roslaunch", 1))
        raise SystemExit(0)  # like argparse after a help text
    try:
        given, nodes = options(words)
        return act(given, nodes)
    except UsageError as error:
        print(error, file=sys.stderr)
        return 2
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def options(words: Sequence[str]) -> tuple[Values, list[str]]:
    """Return the options, which may be at both ends, and the words after the first `+`. Raises ``UsageError``."""
    from .run import split_options

    own, trailing = split_options(words)
    if "+" in own:
        at = own.index("+")
        own, nodes = own[:at], own[at + 1 :]
        if nodes[-1:] == ["--one-process"]:
            nodes, trailing = nodes[:-1], [*trailing, "--one-process"]
    else:
        nodes = []
    made = parser()
    given = made.parse([*own, *trailing])
    if given.sim_time and given.wall_time:
        made.error("--sim-time and --wall-time exclude each other")
    if given.duration is not None and not 0.0 < given.duration < float("inf"):
        made.error(f"--duration {given.duration:g} is not a number of seconds above zero")
    if (given.sim_time or given.wall_time or given.duration is not None or nodes) and not given.one_process:
        made.error("--sim-time, --wall-time, --duration and `+ SCRIPT` need --one-process")
    if min(given.sigint_timeout, given.sigterm_timeout) <= 0.0:
        made.error("--sigint-timeout and --sigterm-timeout are numbers of seconds above zero")
    asked = [name for name in ("node_list", "node_args", "ros_args") if getattr(given, name)]
    if len(asked) > 1:
        made.error("only one of [--nodes, --args, --ros-args] may be specified")
    if not [word for word in given.words if not is_remapping(word)]:
        made.error("you must specify at least one input file")
    return given, nodes


def act(given: Values, nodes: Sequence[str]) -> int:
    """Carry out the options."""
    from rosmini.ros.launch import LaunchError

    packages = PackageIndex()
    try:
        plan = plan_of(given, packages, anonymous())
        if is_question(given):
            found = answer(given, plan, packages)
            print(found)
            return found.status
    except LaunchError as error:
        print(f"RLException: {error}", file=sys.stderr)
        return 1
    plan = changed(plan, given)
    if given.one_process:
        return in_one_process(plan, given, nodes)
    from .launching import launch

    return launch(plan, given, packages)


def is_question(given: Values) -> bool:
    """Return True if the options are only a query."""
    return any(getattr(given, name) for name in ASKING)


def plan_of(given: Values, packages: PackageIndex, names: Callable[[str], str] | None) -> Plan:
    """Read the files, and standard input for ``-``. Raises ``LaunchError``."""
    from rosmini.ros.launch import find_file, read

    files = find_file([word for word in given.words if not is_remapping(word)], packages)
    args = dict(word.split(":=", 1) for word in given.words if is_remapping(word))
    namespace = args.pop("__ns", None) or os.environ.get("ROS_NAMESPACE") or "/"
    return read(
        *(file for file in files if file != "-"),
        args={name: value for name, value in args.items() if not name.startswith("__")},
        text=sys.stdin.read() if "-" in files else None,
        namespace=namespace,
        packages=packages,
        anonymous=names,
        lenient=bool(given.check or given.ros_args or given.file_list),
    )


def anonymous() -> Callable[[str], str]:
    """Return a function that creates names unused in the graph."""
    host = "".join(char if char.isalnum() else "_" for char in socket.gethostname())
    made = 0

    def make(name: str) -> str:
        nonlocal made
        made += 1
        return f"{name}_{host}_{os.getpid()}_{made}"

    return make


def answer(given: Values, plan: Plan, packages: PackageIndex) -> Lines:
    """Return the answer to the query. Raises ``LaunchError``."""
    from rosmini.ros.launch.executables import missing_programs, program

    if given.check:
        return check(plan, [*plan.missing, *missing_programs(plan, packages, os.environ)])
    if given.node_args:
        node = plan.node(given.node_args)
        extra = {"ROS_NAMESPACE": node.namespace.rstrip("/"), **dict(node.environment)}
        shown = [f'{name}="{value}"' for name, value in extra.items() if value and os.environ.get(name) != value]
        prefix = [node.launch_prefix] if node.launch_prefix else []
        text = " ".join([*shown, *prefix, *program(node, packages, os.environ).words, *node.words()])
    elif given.node_list:
        text = "\n".join(node.full_name for node in plan.all_nodes())
    elif given.ros_args:
        text = plan.ros_args()
    elif given.dump_params:
        text = plan.dump()
    else:
        text = "\n".join(os.path.abspath(path) for path in dict.fromkeys(plan.files()))  # noqa: PTH100 - not resolved
    return Lines(lines=(text,))


def check(plan: Plan, missing: Sequence[Missing]) -> Lines:
    """Return the warnings and all missing things; the status is 1 if anything is missing."""
    from rosmini.ros.launch.errors import not_there

    warnings = [f"WARNING: {line}" for line in plan.warnings]
    if missing:
        return Lines(lines=(*warnings, str(not_there(missing))), status=1)
    counts = f"{len(plan.all_nodes())} nodes, {len(plan.settings)} parameters, {len(plan.files())} files"
    return Lines(lines=(*warnings, f"{counts}: all is there"))


def changed(plan: Plan, given: Values) -> Plan:
    """Return the plan changed by --screen and --log."""
    from dataclasses import replace

    if given.force_screen or given.force_log:
        output = "screen" if given.force_screen else "log"
        plan.nodes = [replace(node, output=output) for node in plan.nodes]
    return plan


def in_one_process(plan: Plan, given: Values, nodes: Sequence[str]) -> int:
    """Run all nodes in one graph, with the scripts after a `+`; the status is that of the first failure."""
    from rosmini.core.graph import Graph
    from rosmini.ros.launch.running import Launch, differences, in_graph
    from rosmini.ros.scripts import run_scripts

    specs = nodes_in(nodes) if nodes else []
    simulated = not given.wall_time and (given.sim_time or given.duration is not None)
    plan.warnings += differences(plan)
    end_as_ctrl_c()
    with seldom(), Graph(simulated=simulated, strict=False) as graph:
        say, warn = (partial(print, file=stream, flush=True) for stream in (sys.stdout, sys.stderr))  # not a script's
        timeouts = {"sigint_timeout": given.sigint_timeout, "sigterm_timeout": given.sigterm_timeout}
        launch = Launch(plan, graph, in_graph(graph, to_log=bool(given.force_log)), say=say, warn=warn, **timeouts)
        launch.start()
        try:
            if specs:
                result = run_scripts(specs, graph=graph, duration=given.duration)
                tell(result)
                status = result.status
            else:
                launch.wait(given.duration)
                status = launch.state().status
        except KeyboardInterrupt:
            status = 130
        launch.stop()
    return status
