"""Standard output of several scripts on one terminal: complete lines, in order, each with its node's name."""

from __future__ import annotations

import io
import sys
import threading
from collections.abc import Callable
from typing import TextIO

from rosmini.core.graph.scheduler import CALL_TICKS


class OutputSink:
    """Output of the scripts of one run: the host's standard output and error.

    A line belongs to one script. An unfinished line is shown when its script flushes (a prompt, a progress
    display) and is ended as soon as another script writes.
    """

    to_log = False
    """True if standard output goes to a log and not to the screen."""

    def __init__(self, stdout: TextIO, stderr: TextIO, *, prefix: bool = True) -> None:
        self.stdout = stdout
        self.stderr = stderr
        self.prefix = prefix
        self.lock = threading.RLock()
        self._open: ScriptOutput | None = None

    def emit(self, owner: ScriptOutput, text: str, *, complete: bool) -> None:
        """Write ``text``, a line or the next part of one, on behalf of ``owner``."""
        target = self.stderr if owner.is_error else self.stdout
        if getattr(target, "closed", False) or getattr(self.stdout, "closed", False):
            return
        if owner.is_error and self.stdout is not self.stderr:
            self.stdout.flush()  # what was printed before an error stands before it, also in a pipe
        if self._open is not owner:
            if self._open is not None:
                (self.stderr if self._open.is_error else self.stdout).write("\n")
                self._open = None
            label = self._label(owner)
        else:
            label = ""
        text = text.removesuffix("\r")
        if self.prefix and "\r" in text:
            text = text.replace("\r", "\r" + self._label(owner))
        target.write(f"{label}{text}\n" if complete else label + text)
        self._open = None if complete else owner
        if not complete or owner.is_error or target.isatty():
            target.flush()

    def _label(self, owner: ScriptOutput) -> str:
        return f"[{owner.label()}] " if self.prefix else ""

    def flush(self) -> None:
        """Flush both streams if they are open: a node may outlive the streams of its starter."""
        for stream in (self.stdout, self.stderr):
            if not getattr(stream, "closed", False):
                stream.flush()


class ErrorsOnly(OutputSink):
    """A sink that passes only standard error to another: the screen under `roslaunch --log`."""

    to_log = True

    def __init__(self, sink: OutputSink) -> None:
        super().__init__(sink.stdout, sink.stderr, prefix=sink.prefix)
        self._sink = sink

    def emit(self, owner: ScriptOutput, text: str, *, complete: bool) -> None:
        """Pass on a line of standard error."""
        if owner.is_error:
            self._sink.emit(owner, text, complete=complete)

    def flush(self) -> None:
        """Flush the other sink."""
        self._sink.flush()


class Quiet(ErrorsOnly):
    """A sink that passes only standard error, and no warnings while ``is_starting`` returns True."""

    def __init__(self, sink: OutputSink, is_starting: Callable[[], bool]) -> None:
        super().__init__(sink)
        self._is_starting = is_starting

    def emit(self, owner: ScriptOutput, text: str, *, complete: bool) -> None:
        """Pass on a line of standard error."""
        if not (text.startswith("[WARN]") and self._is_starting()):
            super().emit(owner, text, complete=complete)


class ScriptOutput(io.TextIOBase):
    """``sys.stdout`` or ``sys.stderr`` of one script."""

    def __init__(
        self,
        sink: OutputSink,
        label: Callable[[], str],
        *,
        is_error: bool = False,
        charge: Callable[[int], object] = lambda _: None,
    ) -> None:
        super().__init__()
        self._sink = sink
        self._charge = charge
        self.label = label
        self.is_error = is_error
        self._partial = ""
        self._shown = 0
        self.buffer = _OutputBuffer(self)
        self.name = "<stderr>" if is_error else "<stdout>"
        self.mode = "w"

    @property
    def to_log(self) -> bool:
        """True if its script's standard output goes to a log and not to the screen."""
        return self._sink.to_log

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """Encoding of bytes written to ``buffer``."""
        return "utf-8"

    @property
    def errors(self) -> str:  # type: ignore[override]
        """Error handling for bytes that are not UTF-8."""
        return "backslashreplace"

    def writable(self) -> bool:
        """Return True."""
        return True

    def isatty(self) -> bool:
        """Return True if it is a terminal."""
        return self._target().isatty()

    def fileno(self) -> int:
        """Return the host's descriptor; text written to it directly has no name prefix."""
        return self._target().fileno()

    def reconfigure(self, **_options: object) -> None:
        """Accept the options of ``TextIOWrapper``; complete lines are written at once in any case."""

    def _target(self) -> TextIO:
        return self._sink.stderr if self.is_error else self._sink.stdout

    def write(self, text: str) -> int:
        """Write ``text``; complete lines are written at once."""
        if not isinstance(text, str):
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        with self._sink.lock:
            *lines, rest = (self._partial + text).split("\n")
            for line in lines:
                self._sink.emit(self, line[self._shown :], complete=True)
                self._shown = 0
            self._partial = rest
        if lines:
            self._charge(CALL_TICKS * len(lines))
        return len(text)

    def flush(self) -> None:
        """Show an unfinished line too."""
        with self._sink.lock:
            if len(self._partial) > self._shown:
                self._sink.emit(self, self._partial[self._shown :], complete=False)
                self._shown = len(self._partial)

    def finish(self) -> None:
        """End an unfinished line at the end of the script."""
        with self._sink.lock:
            if self._partial:
                self.write("\n")


class _OutputBuffer(io.RawIOBase):
    """``sys.stdout.buffer``: bytes in, text out."""

    def __init__(self, text: ScriptOutput) -> None:
        super().__init__()
        self._text = text

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        raw = bytes(data)  # type: ignore[call-overload]
        self._text.write(raw.decode("utf-8", "backslashreplace"))
        return len(raw)

    def flush(self) -> None:
        if not self.closed:
            self._text.flush()


class OwnStreams:
    """Context of a built-in node's lanes whose output differs from the host's.

    ``label`` is the prefix of its lines, if the sink uses one.
    """

    def __init__(self, sink: OutputSink, label: str) -> None:
        self._own = {
            "stdout": ScriptOutput(sink, lambda: label),
            "stderr": ScriptOutput(sink, lambda: label, is_error=True),
        }
        self._host = (sys.stdout, sys.stderr)

    def enter(self) -> None:
        """Make these streams ``sys.stdout`` and ``sys.stderr``."""
        self._host = (sys.stdout, sys.stderr)
        sys.stdout, sys.stderr = self._own["stdout"], self._own["stderr"]

    def leave(self) -> None:
        """Restore the host's streams."""
        sys.stdout, sys.stderr = self._host

    def cut_short(self) -> None:
        """Do nothing: a built-in node has no exit status to change."""

    def keeps_polling(self) -> None:
        """Do nothing: the loops of built-in nodes are not counted."""

    def get_own(self, name: str) -> ScriptOutput:
        """Return the node's ``stdout`` or ``stderr``; from any thread."""
        return self._own[name]

    def finish(self) -> None:
        """End unfinished lines at the end of the node."""
        for stream in self._own.values():
            stream.finish()
