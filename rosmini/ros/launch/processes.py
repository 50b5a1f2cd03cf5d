"""Processes as handles: started, awaited, respawned and ended like scripts and built-in nodes of a graph."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from rosmini.core.errors import ScriptError
from rosmini.ros.scripts.console import Console
from rosmini.ros.scripts.handle import LaneHandle

from . import guard as guard_program

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

POLL_NS = 50_000_000
"""Period at which a process is polled for its end [ns]."""

ON_POSIX = os.name == "posix"


class Guard:
    """Ensures that no process outlives this one, however this one ends; on POSIX."""

    def __init__(self) -> None:
        self._process: Any = None
        if ON_POSIX:
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", guard_program.__file__],
                stdin=subprocess.PIPE,
                encoding="utf-8",
                start_new_session=True,
            )

    def started(self, pid: int) -> None:
        """Record a process that was started and leads a process group."""
        self._write(f"+{pid}\n")

    def ended(self, pid: int) -> None:
        """Record that a process has ended."""
        self._write(f"-{pid}\n")

    def close(self) -> None:
        """End the remaining processes and the guard."""
        if self._process is not None:
            with suppress(OSError):
                self._process.stdin.close()
            self._process.wait()

    def _write(self, line: str) -> None:
        if self._process is not None:
            with suppress(OSError):  # it was killed
                self._process.stdin.write(line)
                self._process.stdin.flush()


@dataclass(frozen=True)
class ProcessSpec:
    """A program to run: its command line, environment and folder; ``output`` is a file for its output."""

    name: str
    words: tuple[str, ...]
    environ: Mapping[str, str]
    folder: str
    output: Path | None = None


class ProcessHandle(LaneHandle):
    """A process that leads its own process group; see :class:`~rosmini.ros.scripts.handle.Handle`.

    Times are those of `graph`, which must be in wall-clock time. Raises ``ScriptError`` if it cannot be started.
    """

    def __init__(self, graph: Graph, spec: ProcessSpec, guard: Guard) -> None:
        super().__init__(graph, spec.words, lambda: Console(graph.scheduler))
        self.spec = spec
        self._guard = guard
        self._process: subprocess.Popen[bytes] | None = None
        self._has_started = False

    @property
    def name(self) -> str:
        """Name of the process in messages."""
        return self.spec.name

    @property
    def pid(self) -> int | None:
        """Id of the process that was started last."""
        return None if self._process is None else self._process.pid

    def _launch(self) -> None:
        output: IO[bytes] | None = None
        try:
            if self.spec.output is not None:
                path = self.spec.output
                output = path.open("ab") if self._has_started else path.open("wb")
            self._process = _spawn(self.spec, output)
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
            raise ScriptError(f"{' '.join(self.spec.words)}: cannot be started: {reason}") from error
        finally:
            if output is not None:
                output.close()
        self._has_started = True
        self._guard.started(self._process.pid)
        self._schedule_poll()

    def _schedule_poll(self) -> None:
        self.scheduler.call_at(self.scheduler.now_ns() + POLL_NS, self._poll)

    def _poll(self) -> None:
        process = self._process
        if process is None or not self._running:
            return
        if process.poll() is None:
            self._schedule_poll()
        else:
            self._guard.ended(process.pid)
            self._conclude(process.returncode)

    def _signal(self, signum: signal.Signals) -> None:
        process = self._process
        if process is None or process.poll() is not None:
            return
        with suppress(ProcessLookupError):
            if ON_POSIX:
                os.killpg(process.pid, signum)
            else:
                process.send_signal(getattr(signal, "CTRL_BREAK_EVENT", signal.SIGTERM))

    def end_now(self, returncode: int) -> None:
        """Kill the process."""
        process = self._process
        if process is not None:
            with suppress(ProcessLookupError):
                if ON_POSIX:
                    os.killpg(process.pid, signal.SIGKILL)
                else:
                    process.kill()
            process.wait()
            self._guard.ended(process.pid)
        self._conclude(returncode)


def _spawn(spec: ProcessSpec, output: IO[bytes] | None) -> subprocess.Popen[bytes]:
    """Start a process in a new session; its standard error is that of this process, as in roslaunch."""
    options: dict[str, Any] = {"start_new_session": True}
    if not ON_POSIX:
        options = {"creationflags": getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0)}
    return subprocess.Popen(list(spec.words), stdout=output, env=dict(spec.environ), cwd=spec.folder, **options)


def environment(environ: Mapping[str, str], more: Sequence[tuple[str, str]], namespace: str) -> dict[str, str]:
    """Return the environment of a node: its settings take precedence over the launcher's."""
    return {**environ, "ROS_NAMESPACE": namespace.rstrip("/") or "/", **dict(more)}
