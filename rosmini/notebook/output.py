"""What nodes print, in the cell in which time passes, and what they ask for."""

from __future__ import annotations

import builtins
import io
import signal
import sys
import threading
from typing import TYPE_CHECKING, TextIO, cast

from rosmini.core.errors import ScriptError
from rosmini.ros.scripts.stdin import Feed
from rosmini.ros.scripts.streams import OutputSink

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.ros.scripts.stdin import Blocker
    from rosmini.ros.scripts.streams import ScriptOutput

MAX_LINES = 2_000
"""The largest number of lines that scripts may print in one cell: a loop without a pause prints a million a second."""

_A_MOMENT_NS = 1_000_000


class CellStream(io.TextIOBase):
    """Standard output or error of the cell that runs: nothing while ``is_muted``."""

    def __init__(self, name: str, rewrite: Callable[[str], str]) -> None:
        super().__init__()
        self.name = name
        self.is_muted = False
        self._rewrite = rewrite
        self._target: TextIO = getattr(sys, name)

    def look(self) -> None:
        """Note where the process writes to now. Not for a lane of a script, which has streams of its own."""
        self._target = getattr(sys, self.name)

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """What is written is text."""
        return "utf-8"

    def writable(self) -> bool:
        """Return True."""
        return True

    def write(self, text: str) -> int:
        """Write a text."""
        if not self.is_muted:
            self._target.write(self._rewrite(text))
        return len(text)

    def flush(self) -> None:
        """Flush the cell's stream, unless that was closed first."""
        if not self.is_muted and not self._target.closed:
            self._target.flush()


class CellSink(OutputSink):
    """Where all scripts of a notebook write to; names stand before lines where ``several_speak``."""

    def __init__(self, rewrite: Callable[[str], str], several_speak: Callable[[ScriptOutput], bool]) -> None:
        self._several_speak = several_speak
        self._lines = 0
        self._streams = (CellStream("stdout", rewrite), CellStream("stderr", rewrite))
        out, err = (cast("TextIO", stream) for stream in self._streams)
        super().__init__(out, err)

    def begin_cell(self) -> None:
        """Count from zero: another cell runs."""
        self._lines = 0
        self.look()

    def emit(self, owner: ScriptOutput, text: str, *, complete: bool) -> None:
        """Write a line, or the next part of one, unless that many were written; errors are always written."""
        self._lines += complete and not owner.is_error
        if self._lines <= MAX_LINES or owner.is_error:
            super().emit(owner, text, complete=complete)
        elif self._lines == MAX_LINES + 1:
            self.say(
                f"... and more: a cell shows {MAX_LINES} lines. Does {owner.label()} print in a loop without a "
                "rospy.sleep() or rate.sleep()?"
            )

    def _label(self, owner: ScriptOutput) -> str:
        return super()._label(owner) if self._several_speak(owner) else ""

    def say(self, text: str) -> None:
        """Write a line that is no node's, after what is unfinished."""
        if self._open is not None:
            self.stdout.write("\n")
            self._open = None
        self.stdout.write(f"{text}\n")
        self.stdout.flush()

    def look(self) -> None:
        """Note where the process writes to now."""
        for stream in self._streams:
            stream.look()

    def mute(self, *, muted: bool) -> None:
        """Throw away what is written from now on, or no longer."""
        for stream in self._streams:
            stream.is_muted = muted


class TypedFeed(Feed):
    """Lines that the reader types below the cell in which time passes; graph time stands still meanwhile.

    ``ask`` calls a function in the context of that cell. An interrupt ends that cell, and the script asks again when
    time passes again.
    """

    def __init__(self, ask: Callable[[Callable[[], str]], str], advice: str) -> None:
        super().__init__()
        self._ask = ask
        self._advice = advice

    def _fill(self, who: Blocker) -> None:
        while True:
            try:
                self._text += self._ask(_line) + "\n"
                return
            except EOFError:
                self._ended = True
                return
            except NotImplementedError as error:  # IPython's, where nobody can type
                raise ScriptError(
                    f"the script asks for input, and nobody can type here: {self._advice}"
                ) from error
            except KeyboardInterrupt:
                signal.raise_signal(signal.SIGINT)  # for who drives the graph: it ends the cell
                who.pause("standard input", _A_MOMENT_NS)

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:  # noqa: ARG002
        return True


def _line() -> str:
    """Let the reader type a line, and let an interrupt end that at once."""
    if threading.current_thread() is not threading.main_thread():
        return builtins.input()
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return builtins.input()
    finally:
        signal.signal(signal.SIGINT, before)
