"""A running plan: nodes are started in order, respawned or required as the plan says, and ended together."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import GraphEnded, ParameterNotSet, RosminiError
from rosmini.core.graph import Graph, running_graph
from rosmini.core.packages import PackageIndex
from rosmini.core.rosparam import ParamClient
from rosmini.ros.scripts import Console, NodeHandle, NodeSpec, ScriptHandle, ScriptSpec
from rosmini.ros.scripts.handle import SIGINT_TIMEOUT_S, SIGTERM_TIMEOUT_S, LaneHandle, shell_status

from .processes import environment
from .reader import plan_of

if TYPE_CHECKING:
    from .plan import NodePlan, Plan

CALLER = "/roslaunch"

RULE = "=" * 80

Say = Callable[[str], object]


@dataclass
class Running:
    """A node of a launch; ``name`` is roslaunch's name for its process, ``robot1/talker-2``."""

    name: str
    node: NodePlan
    handle: LaneHandle
    log: str = ""
    """Path of its log files, if it has any."""
    asked_to_end: bool = False


class Launch:
    """The nodes of a plan in one graph, or in separate processes.

    Args:
        plan: the plan to run.
        graph: the graph; code that waits for something drives it.
        make: creates the handle of a node, given the name of its process. Raises ``RosminiError`` if it cannot run.
        say: prints progress, `warn` prints problems.
        first: number of the first process.

    """

    def __init__(
        self,
        plan: Plan,
        graph: Graph,
        make: Callable[[NodePlan, str], Running],
        *,
        say: Say = lambda _: None,
        warn: Say = lambda _: None,
        first: int = 1,
        sigint_timeout: float = SIGINT_TIMEOUT_S,
        sigterm_timeout: float = SIGTERM_TIMEOUT_S,
    ) -> None:
        self.plan, self.graph = plan, graph
        self.running: list[Running] = []
        self.failed: list[NodePlan] = []
        """Nodes that could not be started."""
        self.ending = False
        self.required_ended: Running | None = None
        """The required node whose end ended the launch."""
        self._make, self._say, self._warn = make, say, warn
        self._timeouts = sigint_timeout, sigterm_timeout
        self._next = first

    def __repr__(self) -> str:
        alive = sum(each.handle.poll() is None for each in self.running)
        return f"<Launch: {alive} of {len(self.running)} nodes run>"

    def __getitem__(self, name: str) -> LaneHandle:
        """Return the handle of a node by name. Raises ``LaunchError`` for an unknown one."""
        node = self.plan.node(name)
        for each in self.running:
            if each.node is node:
                return each.handle
        raise RosminiError(f"the node {node.full_name} could not be started")

    # -- its life ------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Set the parameters, then start the nodes in the order of the files."""
        for line in self.plan.warnings:
            self._warn(f"WARNING: {line}")
        set_parameters(self.plan, self.graph)
        for node in self.plan.nodes:
            self.start_node(node)

    def start_node(self, node: NodePlan) -> Running | None:
        """Start one node; return None if that fails."""
        name = f"{node.full_name.lstrip('/')}-{self._next}"
        self._next += 1
        try:
            made = self._make(node, name)
            made.handle.on_end = lambda returncode: self._ended(made, returncode)
            made.handle.on_start = lambda: self._tell_start(made)
            self.running.append(made)
            try:
                made.handle.start()
            except RosminiError:
                self.running.remove(made)
                raise
        except (RosminiError, ValueError) as error:
            self._warn(f"ERROR: cannot launch node of type [{node.executable}]: {node.place}: {error}")
            self.failed.append(node)
            if node.required:
                self._shut_down()
            return None
        return made

    def _tell_start(self, made: Running) -> None:
        pid = getattr(made.handle, "pid", None)
        self._say(f"process[{made.name}]: started" + (f" with pid [{pid}]" if pid is not None else ""))

    def _ended(self, made: Running, returncode: int) -> None:
        """Handle the end of a node."""
        if self.ending or made.asked_to_end or self.graph.closing:
            return
        said = self._how_it_ended(made, returncode)
        node = made.node
        if node.required:
            self._warn(f"{RULE}\nREQUIRED process [{made.name}] has died!\n{said}\nInitiating shutdown!\n{RULE}")
            self.required_ended = made
            self._shut_down()
            return
        (self._warn if returncode else self._say)(f"[{made.name}] {said}")
        if node.respawn:
            self._say(f"[{made.name}] restarting process")
            made.handle.respawn(node.respawn_delay)

    def _how_it_ended(self, made: Running, returncode: int) -> str:
        log = f"\nlog file: {made.log}*.log" if made.log else ""
        if returncode == 0:
            return f"process has finished cleanly{log}"
        pid = getattr(made.handle, "pid", None)
        what = f"pid {pid}, " if pid is not None else ""
        command = " ".join(made.handle.args)
        return f"process has died [{what}exit code {returncode}, cmd {command}].{log}"

    def _shut_down(self) -> None:
        """Ask all nodes to end, last to first, without waiting."""
        if self.ending:
            return
        self.ending = True
        for made in reversed(self.running):
            if made.handle.poll() is None:
                self._say(f"[{made.name}] killing on exit")
                made.handle.terminate(*self._timeouts)

    def over(self) -> bool:
        """Return True if no node runs and none will be respawned."""
        return all(made.handle.poll() is not None for made in self.running)

    def wait(self, timeout: float | None = None) -> RunState:
        """Run the graph until all nodes have ended, or for some seconds of its time.

        No node is ended by this; running nodes continue with the graph. Return the state of all nodes.
        """
        if not self.over():
            self.graph.run(timeout, until=self.over)
        return self.state()

    def stop(self) -> RunState:
        """End all nodes with SIGINT, later SIGTERM, finally SIGKILL; return how they ended."""
        self._shut_down()
        for made in self.running:
            if made.handle.poll() is None:
                with suppress(GraphEnded):
                    made.handle.wait(sum(self._timeouts) + 1.0)
        self.kill()
        return self.state()

    def kill(self) -> None:
        """Kill all nodes."""
        self.ending = True
        for made in self.running:
            made.handle.kill()

    def state(self) -> RunState:
        """Return the state of all nodes."""
        return RunState(tuple((made.node.full_name, made.handle.poll()) for made in self.running), len(self.failed))


@dataclass(frozen=True)
class RunState:
    """Return code of each started node, None while it runs, and the number of nodes that could not be started."""

    codes: tuple[tuple[str, int | None], ...]
    failed: int = 0

    @property
    def status(self) -> int:
        """Exit status: that of the first node that failed, 1 if one could not be started, otherwise 0."""
        found = next((code for _, code in self.codes if code), 0) or 0
        return shell_status(found) or int(self.failed > 0)

    def __str__(self) -> str:
        return "\n".join(f"{name}: {'running' if code is None else f'ended, {code}'}" for name, code in self.codes)


def set_parameters(plan: Plan, graph: Graph) -> None:
    """Set, delete and dump the parameters of a plan. Raises ``RosminiError`` if a file cannot be written."""
    client = ParamClient(graph)
    for verb in plan.verbs:
        with suppress(ParameterNotSet):
            if verb.command == "delete":
                client.delete(verb.name)
            else:
                client.dump(verb.file, verb.name)
    for space in plan.cleared:
        with suppress(ParameterNotSet):
            client.delete(space.rstrip("/") or "/")
    master = graph.ask_as(CALLER)
    for name, setting in plan.settings.items():
        master.ask("setParam", name, setting.value)


def in_graph(
    graph: Graph, packages: PackageIndex | None = None, *, to_log: bool = False, **console: Any
) -> Callable[[NodePlan, str], Running]:
    """Return a function that creates the handles of nodes, which all run in one graph.

    With `to_log` only their standard error appears. `console` has the arguments of `Console`.
    """
    index = packages if packages is not None else PackageIndex()
    shared = Console(graph.scheduler, **console)
    if to_log:
        shared.drop_output()

    def make(node: NodePlan, name: str) -> Running:
        found = index.find_executable(node.package, node.type)
        words = node.words(with_namespace=True)
        handle: LaneHandle
        if found.path is None:
            handle = NodeHandle(graph, NodeSpec(found, words, node.environment), lambda: shared, owns_console=False)
        else:
            environ = tuple(environment({}, node.environment, node.namespace).items())
            spec = ScriptSpec(str(found.path), words, environ=environ)
            handle = ScriptHandle(graph, spec, lambda: shared, seed=f"0/{name}", owns_console=False)
        return Running(name, node, handle)

    return make


def differences(plan: Plan) -> Iterator[str]:
    """Yield the parts of a plan that one process cannot carry out."""
    for node in plan.nodes:
        if node.launch_prefix:
            yield f'{node.place}: launch-prefix="{node.launch_prefix}" is for a process: it is ignored in one graph'
        if node.cwd and node.cwd.lower() != "cwd":
            yield (
                f'{node.place}: cwd="{node.cwd}" is for a process: in one graph {node.full_name} works in the folder '
                "of this one"
            )
        if node.machine and not plan.machines[node.machine].is_local:
            yield f"{node.place}: {on_machine(plan, node)}; here it runs in this process"


def on_machine(plan: Plan, node: NodePlan) -> str:
    """Return a hint for a node that belongs on another machine."""
    machine = plan.machines[node.machine]
    user = f"{machine.user}@" if machine.user else ""
    port = f" -p {machine.ssh_port}" if machine.ssh_port != 22 else ""
    loader = [machine.env_loader] if machine.env_loader else []
    command = [*loader, "rosrun", node.package, node.type, *node.words(with_namespace=True)]
    there = " ".join(shlex.quote(shlex.quote(word)) for word in command)  # two shells read it
    return (
        f"{node.full_name} belongs on the machine {machine.name!r} ({user}{machine.address}), and rosmini starts "
        f"nothing over SSH. There: ssh{port} {shlex.quote(user + machine.address)} {there}"
    )


def log_base(folder: Path | None, name: str) -> str:
    """Return the prefix of a process's log files."""
    return "" if folder is None else str(folder / name.replace("/", "-"))


def roslaunch(
    *words: str | os.PathLike[str], graph: Graph | None = None, console: dict[str, Any] | None = None, **args: Any
) -> Launch:
    """Start all nodes of launch files in one graph and return at once; they run while the graph is driven.

    It is `roslaunch` for notebooks and programs (http://wiki.ros.org/roslaunch).

    Args:
        words: as for `plan_of`.
        graph: where to run; by default the graph that runs the caller, or else the default graph.
        console: ``stdin``, ``stdout``, ``stderr``, ``prefix`` and ``capture_output`` of
            :class:`~rosmini.ros.scripts.Console`.
        args: arguments of the launch file as keyword arguments.

    Raises:
        LaunchError: as for `plan_of`.

    """
    plan = plan_of(*words, **args)
    used = running_graph() if graph is None else graph
    out = (console or {}).get("stdout") or sys.stdout
    warn = partial(print, file=out, flush=True)
    launch = Launch(plan, used, in_graph(used, **(console or {})), warn=warn)
    plan.warnings += differences(plan)
    launch.start()
    return launch
