"""The standard streams of scripts and nodes that run together: output in whole lines, and one input."""

from __future__ import annotations

import io
import sys
from typing import TYPE_CHECKING, Any, TextIO

from .failures import user_traceback
from .stdin import make_feed
from .streams import ErrorsOnly, OutputSink, ScriptOutput

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler


class Console:
    """Input and output of scripts and nodes.

    Args:
        scheduler: the graph's scheduler, which continues while a script waits for input.
        stdin: a text, pieces of text with the second at which each arrives, a file, or
            None for the host's; or a :class:`~rosmini.ros.scripts.stdin.Feed`.
        stdout: stream for output; by default the host's.
        stderr: stream for errors and warnings; by default the host's.
        prefix: put ``[name]`` before each line.
        capture_output: store output and errors in :attr:`captured` instead.
        sink: shared output of several consoles, instead of the other arguments.

    """

    def __init__(
        self,
        scheduler: Scheduler,
        *,
        stdin: Any = None,
        stdout: TextIO | None = None,
        stderr: TextIO | None = None,
        prefix: bool = True,
        capture_output: bool = False,
        sink: OutputSink | None = None,
    ) -> None:
        self._captured = io.StringIO() if capture_output else None
        self.is_apart = capture_output or stdout is not None or stderr is not None or (sink is not None and sink.to_log)
        """True if it writes elsewhere than the host."""
        self.sink = sink or OutputSink(
            self._captured or stdout or sys.stdout, self._captured or stderr or sys.stderr, prefix=prefix
        )
        self.feed = make_feed(scheduler, stdin)

    @property
    def captured(self) -> str | None:
        """Output captured so far, or None."""
        return None if self._captured is None else self._captured.getvalue()

    def drop_output(self) -> None:
        """Show only standard error from now on."""
        self.sink = ErrorsOnly(self.sink)
        self.is_apart = True

    def report(self, name: str, error: BaseException) -> None:
        """Write the traceback of the error that ended ``name``, with only the user's frames."""
        ScriptOutput(self.sink, lambda: name, is_error=True).write(user_traceback(error))

    def flush(self) -> None:
        """Flush all output."""
        self.sink.flush()

    def close(self) -> None:
        """Release waiting readers, and flush all output."""
        self.feed.close()
        self.flush()
