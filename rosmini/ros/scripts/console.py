"""The standard streams of what runs together: output in whole lines, and one input."""

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
    """Where scripts and nodes write to and read from.

    Args:
        scheduler: the graph's, which goes on while a script waits for input.
        stdin: a text, pieces of text with the second at which each arrives, a file, a function that returns a line, or
            None for the host's; or a :class:`~rosmini.ros.scripts.stdin.Feed`.
        stdout: where output goes; the host's if not given.
        stderr: where errors and warnings go; the host's if not given.
        prefix: put ``[name]`` before each line.
        capture_output: keep output and errors in :attr:`captured` instead.
        sink: where several consoles write to together, instead of all that.

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
        self.is_apart = capture_output or stdout is not None or stderr is not None
        """Whether it writes somewhere else than the host does."""
        self.sink = sink or OutputSink(
            self._captured or stdout or sys.stdout, self._captured or stderr or sys.stderr, prefix=prefix
        )
        self.feed = make_feed(scheduler, stdin)

    @property
    def captured(self) -> str | None:
        """What was written so far, if it is kept."""
        return None if self._captured is None else self._captured.getvalue()

    def drop_output(self) -> None:
        """Show only standard error from now on."""
        self.sink = ErrorsOnly(self.sink)
        self.is_apart = True

    def report(self, name: str, error: BaseException) -> None:
        """Write the traceback of what ended ``name``, the user's frames only."""
        ScriptOutput(self.sink, lambda: name, is_error=True).write(user_traceback(error))

    def flush(self) -> None:
        """Flush all output."""
        self.sink.flush()

    def close(self) -> None:
        """Release whoever still reads, and flush all output."""
        self.feed.close()
        self.flush()
