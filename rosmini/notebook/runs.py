"""The runs of a notebook: a cell starts a run, and running the cell again restarts it."""

from __future__ import annotations

import signal
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.names import Remappings
from rosmini.ros.scripts import ScriptHandle, StillRunning

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rosmini.core.graph import Graph
    from rosmini.ros.launch import Launch
    from rosmini.ros.scripts import NodeHandle
    from rosmini.ros.scripts.streams import ScriptOutput

GRACE_S = 3.0
"""Time that a run has to end after Ctrl-C [s of graph time]."""


class RunKey(NamedTuple):
    """Identifies a run: its file (or ``package/executable``), and ``__ns`` and ``__name`` of its arguments."""

    what: str
    namespace: str
    name: str

    @classmethod
    def of(cls, what: str, words: Sequence[str]) -> RunKey:
        """Return the key of a command line. Raises ``ROSInitException`` for an invalid remapping."""
        given = Remappings.from_argv(words)
        return cls(what, given.namespace or "", given.node_name or "")


@dataclass
class Run:
    """A run, and its name in messages."""

    title: str
    handle: ScriptHandle | NodeHandle
    may_print: bool
    """True if its source seems to print, or if it has printed."""

    @property
    def node_name(self) -> str:
        """Name of its node, or "" if there is none yet."""
        node = self.handle.node
        return "" if node is None else str(node.name)

    @property
    def is_running(self) -> bool:
        """True until it ends."""
        return self.handle.poll() is None


class Runs:
    """All runs of a graph.

    ``say`` writes a line into the cell.
    """

    def __init__(self, graph: Graph, say: Callable[[str], object]) -> None:
        self.graph = graph
        self._say = say
        self._runs: dict[RunKey, Run] = {}
        self._launches: dict[tuple[str, ...], Launch] = {}

    def several_print(self, speaker: ScriptOutput) -> bool:
        """Return whether several running scripts may print; ``speaker`` has just printed."""
        for run in self._runs.values():
            run.may_print |= isinstance(run.handle, ScriptHandle) and run.is_running and run.handle.writes(speaker)
        launched = (made.handle for launch in self._launches.values() for made in launch.running)
        speakers = sum(run.may_print and run.is_running for run in self._runs.values())
        scripts = sum(isinstance(handle, ScriptHandle) and handle.poll() is None for handle in launched)
        return speakers + scripts > 1

    def launch(self, words: Sequence[str], start: Callable[[], Launch | None]) -> None:
        """Start launch files until their nodes block. An earlier launch with the same words ends first."""
        before = self._launches.pop(tuple(words), None)
        if before is not None:
            before.stop()
        made = start()
        if made is not None:
            self._launches[tuple(words)] = made
            self.graph.run(0)

    def start(
        self,
        key: RunKey,
        title: str,
        make: Callable[[], ScriptHandle | NodeHandle],
        *,
        may_print: bool,
        is_readers: bool = False,
    ) -> Run:
        """Start the result of ``make`` until it blocks; no time passes. An earlier run with this key ends first.

        If the script is the reader's and ends at once, a line says so. Raises the errors of ``make``; then nothing was
        ended.
        """
        handle = make()
        self._end(key)
        run = Run(title, handle, may_print)
        handle.on_end = lambda status: self._ended(run, status)
        handle.start()
        self._runs[key] = run
        self.graph.run(0)
        if is_readers and handle.poll() == 0 and run.node_name:
            self._say(f"{title} has ended, and its node {run.node_name} with it; rospy.spin() keeps a node alive.")
        return run

    def _end(self, key: RunKey) -> None:
        """Ask the run of a key to end, like Ctrl-C, and kill it if it does not."""
        run = self._runs.get(key)
        if run is None or not run.is_running:
            return
        run.handle.send_signal(signal.SIGINT)
        try:
            run.handle.wait(GRACE_S)
        except StillRunning:
            run.handle.kill()
            self._say(f"{run.title} did not end within {GRACE_S:g} s of Ctrl-C, and was killed.")
        except KeyboardInterrupt:  # the reader does not want to wait
            run.handle.kill()
            raise

    def _ended(self, run: Run, status: int) -> None:
        node = run.handle.node
        if node is not None and "same name" in (node.shutdown_reason or ""):
            newer = [each for each in self._runs.values() if each.is_running and each.node_name == node.name]
            for each in newer:
                self._say(
                    f"{each.title} and {run.title} both call their node {node.name}: "
                    f"the Master has ended the older one, that of {run.title}."
                )
        elif status > 0:
            self._say(f"{run.title} has ended with exit status {status}.")
        elif status < 0 and isinstance(run.handle, ScriptHandle) and run.handle.ended_itself:
            self._say(f"{run.title} has ended by {signal.Signals(-status).name}, which it sent to itself.")
