"""Running scripts as nodes of one graph: from their files to an exit status."""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TextIO

from rosmini.errors import ROSInterruptException, ScriptError
from rosmini.graph import Graph, LaneExit, set_default_graph
from rosmini.graph.event_queue import span_ns

from .context import ScriptContext
from .executables import BuiltIn
from .failures import user_traceback
from .source import Source, compile_script, forget_lines, read_script, remember_lines
from .stdin import make_feed
from .streams import OutputSink, ScriptOutput

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from types import ModuleType

    from rosmini.graph import RunReport
    from rosmini.packages import Executable

END_GRACE_S = 0.2
"""How long a script may take to end once it was thrown out of its last blocking call, in seconds of graph time."""

INTERRUPTED = 130
"""The exit status of a program that Ctrl-C ended (128 + SIGINT)."""


@dataclass(frozen=True)
class ScriptSpec:
    """A script to run: ``path`` with ``args``, or the text ``source`` under the name ``path``."""

    path: str
    args: tuple[str, ...] = ()
    source: str | None = None


@dataclass(frozen=True)
class NodeSpec:
    """A built-in node to run beside scripts, with its ROS arguments."""

    executable: Executable
    args: tuple[str, ...] = ()


@dataclass(frozen=True)
class RunResult:
    """How a run ended.

    ``status`` is that of the first that failed, or 0; ``statuses`` has those of the scripts and then those of the built-in nodes, each in the order given; ``reason`` is
    "ended" (all scripts have), "time" (the duration is over), "drained" (nothing is left to happen), "stopped" or "interrupted" (Ctrl-C).
    """

    status: int
    statuses: tuple[int, ...]
    reason: str
    report: RunReport | None


class _Script:
    """One script of a run: from its first line to its exit status."""

    def __init__(self, context: ScriptContext, source: Source) -> None:
        self.context = context
        self.source = source
        self.status = 0
        self.finished = False
        self.asked = False

    def start(self) -> None:
        context = self.context
        lane = context.scheduler.spawn(context.name, context=context, on_error=context.lane_failed)
        lane.node = None  # not the node of the notebook cell that starts it
        lane.on_exit = self._finished
        context.main_lane = lane
        main = context.thread_class()(name="MainThread", daemon=False)
        main.adopt(lane, next(context.threads.idents))
        context.threads.main = main
        lane.submit(self._main)

    def _main(self) -> None:
        try:
            self._execute()
            self._finish()
        except LaneExit:
            pass
        finally:
            self._finished()

    def _finished(self) -> None:
        self.finished = True

    def _execute(self) -> None:
        context, source = self.context, self.source
        namespace = context.main_module.__dict__
        namespace["__doc__"] = source.doc
        try:
            exec(source.code, namespace)  # noqa: S102 - this is what running a script is
        except SystemExit as request:
            self.status = _exit_status(request, context)
        except LaneExit:
            pass  # the run is over
        except ROSInterruptException as error:
            if not self.asked:
                self._failed(error)
        except KeyboardInterrupt as error:
            if self.asked:
                self.status = INTERRUPTED
            else:
                self._failed(error)
        except BaseException as error:
            self._failed(error)

    def _failed(self, error: BaseException) -> None:
        self.status = 1
        context = self.context
        sys_shim = context.importer.private.get("sys")
        hook = None if sys_shim is None else vars(sys_shim).get("excepthook")
        if hook is not None and hook is not sys.excepthook:
            try:
                hook(type(error), error, error.__traceback__)
                return
            except Exception as second:
                context.get_own("stderr").write(f"Error in sys.excepthook:\n{user_traceback(second)}")
        context.get_own("stderr").write(user_traceback(error))

    def _finish(self) -> None:
        """Do what Python does at the end of a program: wait for threads, then ``atexit``; then the node shuts down."""
        context = self.context
        try:
            while context.threads.at_end:
                context.threads.at_end.pop()()
            self._wait_for_threads()
        except (LaneExit, KeyboardInterrupt):
            pass
        context.run_exit_calls()
        context.run_shutdown("the script has ended")
        context.end()

    def _wait_for_threads(self) -> None:
        threads = self.context.threads
        while True:
            waited_for = [
                thread for thread in threads.alive() if thread is not threads.main and not thread.daemon
            ]
            if not waited_for:
                return
            waited_for[0].join()

    @property
    def exit_status(self) -> int:
        """The exit status: its own, or that of a program that Ctrl-C ended if it was cut short."""
        return self.status or (INTERRUPTED if self.context.was_cut_short else 0)

    def ask_to_end(self, reason: str, *, interrupt: bool) -> None:
        """Ask the script to end, as Ctrl-C does in ROS (``interrupt``) or without a signal."""
        context = self.context
        if interrupt:
            self.asked = context.deliver(2)
        if context.at_shutdown:
            self.asked = True
            context.scheduler.spawn(
                f"{context.name} shutdown", lambda: context.run_shutdown(reason), context=context
            )


def _exit_status(request: SystemExit, context: ScriptContext) -> int:
    code = request.code
    if code is None:
        return 0
    if isinstance(code, int):
        return code & 0xFF
    context.get_own("stderr").write(f"{code}\n")
    return 1


class _Run:
    """The scripts of one call of :func:`run_scripts`."""

    def __init__(
        self, graph: Graph, scripts: Sequence[_Script], nodes: Sequence[BuiltIn], grace: float
    ) -> None:
        self.graph = graph
        self.scheduler = graph.scheduler
        self.scripts = scripts
        self.nodes = nodes
        self.grace = grace

    def over(self) -> bool:
        """Tell whether all scripts have ended, or, where there are only built-in nodes, all of these."""
        if self.scripts:
            return all(script.finished for script in self.scripts)
        return all(node.ended for node in self.nodes)

    def drive(self, duration: float | None) -> tuple[str, RunReport | None]:
        """Let the scripts run; return why they stopped and the report."""
        until_ns = (
            None if duration is None else self.scheduler.now_ns() + span_ns(duration, "a run's duration")
        )
        for node in self.nodes:
            node.start()
        for script in self.scripts:
            script.start()
        try:
            report = self.scheduler.run(until_ns=until_ns, until=self.over)
        except KeyboardInterrupt:
            return "interrupted", None
        return ("ended" if report.reason == "condition" else report.reason), report

    def end(self, reason: str) -> None:
        """Ask the scripts that still run to end; throw out those that do not."""
        why = {
            "interrupted": "Ctrl-C",
            "time": "the time is over",
            "drained": "nothing is left to happen",
        }.get(reason, reason)
        running = [script for script in self.scripts if not script.finished]
        for script in running:
            script.ask_to_end(why, interrupt=reason == "interrupted")
        asked = [script for script in running if script.asked]
        if asked:
            self._go_on(self.grace, lambda: all(script.finished for script in asked))
        for script in running:
            if not script.finished:
                if reason == "interrupted":
                    script.context.cut_short()
                script.context.raise_in_main(LaneExit("the run is over"))
        self._go_on(END_GRACE_S, self.over)
        for script in self.scripts:
            script.context.end()
            if not script.finished and script.context.main_lane is not None:
                script.context.main_lane.kill()
        for node in self.nodes:
            node.end(why)
        self._go_on(END_GRACE_S, lambda: self.over() and not self._threads_left())

    def _threads_left(self) -> bool:
        return any(
            thread is not script.context.threads.main
            for script in self.scripts
            for thread in script.context.threads.alive()
        )

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
    """Run scripts written for rospy as nodes of one graph, and return how it ended.

    Args:
        specs: the scripts, all of which are read before the first starts, and built-in nodes, which start before the scripts and are
            shut down when these have ended.
        simulated: simulated time, or wall time (ignored with ``graph``).
        duration: end after so many seconds of graph time; None: when all have ended, or nothing is left to happen.
        graph: run in this graph, which stays as it is afterwards; a new one if not given.
        rate: in wall time, how many seconds of graph time pass in one second (ignored with ``graph``).
        seed: what the scripts' random numbers start from in simulated time.
        stdin: the scripts' standard input: a text, pieces of text with the second at which each arrives, a file, a function
            that returns a line, or None for the host's.
        stdout: where the output goes; the host's if not given.
        stderr: where errors and warnings go; the host's if not given.
        prefix: put ``[name]`` before each line.
        grace: how many seconds of graph time a script has to end after it was asked to.
        folders: where the scripts' modules may be, besides the folder of each.
        modules: the client library, by the names under which scripts import it; rosmini's rospy if not given.

    Raises:
        ScriptError: a script is not there or is not Python.

    """
    if not specs:
        raise ScriptError("no script was given")
    script_specs = [spec for spec in specs if isinstance(spec, ScriptSpec)]
    sources = [_read(spec) for spec in script_specs]
    if modules is None:
        from rosmini.rospy.importer import modules as rospy_modules

        modules = rospy_modules()
    with _graph_for_run(graph, simulated=simulated, rate=rate, seed=seed) as used:
        sink = OutputSink(stdout or sys.stdout, stderr or sys.stderr, prefix=prefix)
        feed = make_feed(used.scheduler, stdin)
        folder = os.getcwd()  # noqa: PTH109 - kept as it is, to go back
        nodes = [_built_in(used, spec, sink) for spec in specs if isinstance(spec, NodeSpec)]
        scripts = []
        for number, (spec, source) in enumerate(zip(script_specs, sources, strict=True)):
            context = ScriptContext(
                used.scheduler,
                source.filename,
                [spec.path, *spec.args],
                sink=sink,
                feed=feed,
                seed=f"{seed}/{number}/{spec.path.replace(os.sep, '/').rpartition('/')[2]}",
                folders=folders,
                modules=modules,
            )
            scripts.append(_Script(context, source))
        run = _Run(used, scripts, nodes, grace)
        try:
            reason, report = run.drive(duration)
            run.end(reason)
        finally:
            feed.close()
            for spec, script in zip(script_specs, scripts, strict=True):
                script.context.close()
                if spec.source is not None:
                    forget_lines(script.source.filename)
            sink.flush()
            os.chdir(folder)
    statuses = (*(script.exit_status for script in scripts), *(node.status for node in nodes))
    return RunResult(next(filter(None, statuses), 0), statuses, reason, report)


def run_source(text: str, args: Sequence[str] = (), *, name: str = "script", **options: Any) -> RunResult:
    """Run the text of a script; the options are those of :func:`run_scripts`.

    >>> run_source("print('hello')", name="greeter").status
    [greeter] hello
    0
    """
    return run_scripts([ScriptSpec(name, tuple(args), source=text)], **options)


def _built_in(graph: Graph, spec: NodeSpec, sink: OutputSink) -> BuiltIn:
    stderr = ScriptOutput(sink, lambda: spec.executable.name, is_error=True)
    return BuiltIn(graph, spec.executable, spec.args, lambda error: stderr.write(user_traceback(error)))


def _read(spec: ScriptSpec) -> Source:
    if spec.source is None:
        return read_script(spec.path)
    filename = f"<{spec.path}>"
    source = compile_script(spec.source.encode(), filename)
    remember_lines(filename, spec.source)
    return source


@contextmanager
def _graph_for_run(graph: Graph | None, *, simulated: bool, rate: float, seed: int) -> Iterator[Graph]:
    """Make ``graph``, or a new one that is shut down afterwards, the one that rospy finds."""
    own = graph is None
    if graph is None:
        graph = Graph(simulated=simulated, rate=rate, seed=seed, strict=False)
    before = set_default_graph(graph)
    try:
        yield graph
    finally:
        if own:
            graph.shutdown("the run is over")
        set_default_graph(before)
