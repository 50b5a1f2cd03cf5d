"""Runs scripts as nodes of one graph: from their files to an exit status; and `rosrun`, which starts one node."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from types import ModuleType
from typing import Any, TextIO

from rosmini.core.errors import ScriptError
from rosmini.core.graph import Graph, RunReport, running_graph
from rosmini.core.graph.event_queue import span_ns
from rosmini.core.packages import Executable, PackageIndex

from .console import Console
from .handle import shell_status
from .node_handle import NodeHandle, NodeSpec
from .script_handle import END_GRACE_S, INTERRUPTED, ScriptHandle, ScriptSpec


@dataclass(frozen=True)
class RunResult:
    """Result of a run.

    ``status`` is that of the first that failed, or 0; ``statuses`` has those of the scripts and then those of the
    built-in nodes, each in the given order; ``reason`` is "ended" (all scripts ended), "time" (the duration is over),
    "drained" (no event is left), "stopped" or "interrupted" (Ctrl-C).
    """

    status: int
    statuses: tuple[int, ...]
    reason: str
    report: RunReport | None


class _Run:
    """The scripts and nodes of one call of :func:`run_scripts`."""

    def __init__(
        self, graph: Graph, scripts: Sequence[ScriptHandle], nodes: Sequence[NodeHandle], grace: float
    ) -> None:
        self.scheduler = graph.scheduler
        self.scripts = scripts
        self.nodes = nodes
        self.grace = grace

    def over(self) -> bool:
        """Return True if all scripts have ended, or all nodes if there are only built-in nodes."""
        return all(each.poll() is not None for each in self.scripts or self.nodes)

    def drive(self, duration: float | None) -> tuple[str, RunReport | None]:
        """Run the scripts; return why they stopped and the report."""
        until_ns = None if duration is None else self.scheduler.now_ns() + span_ns(duration, "a run's duration")
        for each in (*self.nodes, *self.scripts):
            each.start()
        try:
            report = self.scheduler.run(until_ns=until_ns, until=self.over)
        except KeyboardInterrupt:
            return "interrupted", None
        return ("ended" if report.reason == "condition" else report.reason), report

    def end(self, reason: str) -> None:
        """Ask the running scripts and nodes to end; force out the scripts that do not."""
        why = {"interrupted": "Ctrl-C", "time": "the time is over", "drained": "nothing is left to happen"}.get(
            reason, reason
        )
        interrupted = reason == "interrupted"
        running = [script for script in self.scripts if script.poll() is None]
        asked = [script for script in running if (script.interrupt(why) if interrupted else script.ask_to_end(why))]
        if asked:
            self._go_on(self.grace, lambda: all(script.poll() is not None for script in asked))
        for script in running:
            if script.poll() is None:
                if interrupted:
                    script.context.cut_short()
                script.throw_out()
        self._go_on(END_GRACE_S, self._scripts_have_ended)
        for script in self.scripts:
            if script.poll() is None:
                script.end_now(INTERRUPTED if script.context.was_cut_short else 0)
        for node in self.nodes:
            if node.poll() is None:
                node.ask_to_end(why)
        self._go_on(
            END_GRACE_S, lambda: self._scripts_have_ended() and all(node.poll() is not None for node in self.nodes)
        )

    def _scripts_have_ended(self) -> bool:
        return all(script.poll() is not None for script in self.scripts)

    def _go_on(self, seconds: float, until: Callable[[], bool]) -> None:
        scheduler = self.scheduler
        with suppress(KeyboardInterrupt):  # a second Ctrl-C: no more patience
            scheduler.run(until_ns=scheduler.now_ns() + round(seconds * 1e9), until=until)


def run_scripts(
    specs: Sequence[ScriptSpec | NodeSpec],
    *,
    simulated: bool = True,
    duration: float | None = None,
    graph: Graph | None = None,
    rate: float = 1.0,
    seed: int = 0,
    stdin: Any = None,
    stdout: TextIO | None = None,
    stderr: TextIO | None = None,
    prefix: bool = True,
    grace: float = 3.0,
    folders: Sequence[str] = (),
    modules: Mapping[str, ModuleType] | None = None,
) -> RunResult:
    """Run rospy scripts as nodes of one graph, and return the result.

    Args:
        specs: the scripts, which are all read before the first starts, and built-in nodes, which start before the
            scripts and are shut down after them.
        simulated: use simulated time, otherwise wall-clock time (ignored with ``graph``).
        duration: end after this many seconds of graph time; None: when all have ended, or no event is left.
        graph: run in this graph and keep it; by default in a new one.
        rate: in wall-clock time, seconds of graph time per second (ignored with ``graph``).
        seed: seed of the scripts' random numbers in simulated time.
        stdin: the scripts' standard input: a text, pieces of text with the second at which each arrives, a file,
            or None for the host's.
        stdout: stream for output; by default the host's.
        stderr: stream for errors and warnings; by default the host's.
        prefix: put ``[name]`` before each line.
        grace: seconds of graph time that a script has to end once asked to.
        folders: folders with the scripts' modules, besides the folder of each script.
        modules: the client library, by the names under which scripts import it; by default rosmini's rospy.

    Raises:
        ScriptError: a script is missing or is not Python.

    """
    if not specs:
        raise ScriptError("no script was given")
    with _graph_for_run(graph, simulated=simulated, rate=rate, seed=seed) as used:
        console = Console(used.scheduler, stdin=stdin, stdout=stdout, stderr=stderr, prefix=prefix)
        handles: list[ScriptHandle | NodeHandle] = []
        for spec in specs:
            if isinstance(spec, NodeSpec):
                handles.append(NodeHandle(used, spec, lambda: console, owns_console=False))
            else:
                own_seed = f"{seed}/{sum(isinstance(each, ScriptHandle) for each in handles)}"
                handles.append(
                    ScriptHandle(
                        used, spec, lambda: console,
                        seed=own_seed, folders=folders, modules=modules, owns_console=False,
                    )
                )  # fmt: skip
        scripts = [each for each in handles if isinstance(each, ScriptHandle)]
        nodes = [each for each in handles if isinstance(each, NodeHandle)]
        folder = os.getcwd()  # noqa: PTH109 - kept as it is, to go back
        run = _Run(used, scripts, nodes, grace)
        try:
            reason, report = run.drive(duration)
            run.end(reason)
        finally:
            for each in handles:
                each.kill()
            console.close()
            os.chdir(folder)
    statuses = tuple(shell_status(each.poll() or 0) for each in (*scripts, *nodes))
    return RunResult(next(filter(None, statuses), 0), statuses, reason, report)


def run_source(text: str, args: Sequence[str] = (), *, name: str = "script", **options: Any) -> RunResult:
    """Run the text of a script; the options are those of :func:`run_scripts`.

    >>> run_source("print('hello')", name="greeter").status
    [greeter] hello
    0
    """
    return run_scripts([ScriptSpec(name, tuple(args), source=text)], **options)


@contextmanager
def _graph_for_run(graph: Graph | None, *, simulated: bool, rate: float, seed: int) -> Iterator[Graph]:
    """Yield ``graph``, or a new one that is shut down afterwards."""
    if graph is not None:
        yield graph
        return
    made = Graph(simulated=simulated, rate=rate, seed=seed, strict=False)
    try:
        yield made
    finally:
        made.shutdown("the run is over")


def find(name: str) -> Executable:
    """Return the executable named by ``package/executable``.

    Raises ``ScriptError`` if the name is invalid or there is no such executable, and ``UnknownPackage``.
    """
    package, slash, executable = name.partition("/")
    if not (package and slash and executable) or "/" in executable:
        raise ScriptError(f"{name!r} is not of the form PACKAGE/EXECUTABLE, for example rosmini_sim/simulator")
    return PackageIndex().find_executable(package, executable)


def rosrun(
    package: str,
    executable: str,
    *args: str | os.PathLike[str],
    graph: Graph | None = None,
    seed: int = 0,
    **console: Any,
) -> ScriptHandle | NodeHandle:
    """Start an executable of a package, like `rosrun package executable args &`, and return its handle at once.

    See http://wiki.ros.org/rosbash#rosrun.

    It runs while the graph is driven: by ``graph.run()``, by ``handle.wait()`` until it ends, or by
    ``handle.instance()`` until a built-in node is set up, which returns the object created by the node.

    Args:
        package: the package's name.
        executable: the name of a built-in node, or of a script in the package.
        args: ROS's arguments (``"scan:=/laser"``, ``"__name:=sim2"``, ``"__ns:=/robot1"``, ``"_rate:=10"``), and
            words and paths for the executable itself.
        graph: where to run; by default the graph that runs the caller, or else the default graph.
        seed: seed of a script's random numbers in simulated time.
        console: ``stdin``, ``stdout``, ``stderr``, ``prefix`` and ``capture_output`` of
            :class:`~rosmini.ros.scripts.Console`.

    Raises:
        UnknownPackage: there is no such package.
        ScriptError: the package has no such executable, or it does not accept these arguments, or is not Python.
        RosminiError: a name or a parameter in the arguments is invalid.

    """
    found = find(f"{package}/{executable}")
    words = tuple(os.fspath(each) for each in args)
    used = running_graph() if graph is None else graph

    def make_console() -> Console:
        return Console(used.scheduler, **console)

    handle: ScriptHandle | NodeHandle
    if found.path is None:
        handle = NodeHandle(used, NodeSpec(found, words), make_console)
    else:
        handle = ScriptHandle(used, ScriptSpec(str(found.path), words), make_console, seed=f"{seed}/0")
    handle.start()
    return handle
