"""Output and input of nodes, in the cell in which time passes."""

from __future__ import annotations

import builtins
import io
import signal
import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TextIO, cast

from rosmini.core.errors import ScriptError
from rosmini.ros.scripts.stdin import Feed
from rosmini.ros.scripts.streams import OutputSink

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.ros.scripts.stdin import Blocker
    from rosmini.ros.scripts.streams import ScriptOutput

MAX_LINES = 2_000
"""Largest number of lines that scripts may print in one cell: a loop without a pause prints a million a second."""

_A_MOMENT_NS = 1_000_000


@contextmanager
def progress_in_cell(text: str) -> Iterator[None]:
    """Show a text below the running cell during the block, and remove it at the end."""
    from IPython import display

    show: Any = display.display
    shown = show({"text/plain": text}, raw=True, display_id=True)
    try:
        yield
    finally:
        shown.update({"text/plain": ""}, raw=True)


class CellStream(io.TextIOBase):
    """Standard output or error of the running cell; discards everything while ``is_muted``."""

    def __init__(self, name: str, rewrite: Callable[[str], str]) -> None:
        super().__init__()
        self.name = name
        self.is_muted = False
        self._rewrite = rewrite
        self._target: TextIO = getattr(sys, name)

    def attach(self) -> None:
        """Write to the process's present stream. Do not call this in a script's lane, which has separate streams."""
        self._target = getattr(sys, self.name)

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The encoding, since text is written."""
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
        """Flush the cell's stream, unless it is already closed."""
        if not self.is_muted and not self._target.closed:
            self._target.flush()


class CellSink(OutputSink):
    """The output of all scripts of a notebook; lines begin with a script's name if ``several_print``."""

    def __init__(self, rewrite: Callable[[str], str], several_print: Callable[[ScriptOutput], bool]) -> None:
        self._several_print = several_print
        self._lines = 0
        self._streams = (CellStream("stdout", rewrite), CellStream("stderr", rewrite))
        out, err = (cast("TextIO", stream) for stream in self._streams)
        super().__init__(out, err)

    def begin_cell(self) -> None:
        """Reset the count of lines for a new cell."""
        self._lines = 0
        self.attach()

    def emit(self, owner: ScriptOutput, text: str, *, complete: bool) -> None:
        """Write a line, or part of one, up to the largest number of lines; errors are always written."""
        self._lines += complete and not owner.is_error
        if self._lines <= MAX_LINES or owner.is_error:
            super().emit(owner, text, complete=complete)
        elif self._lines == MAX_LINES + 1:
            self.say(
                f"... and more: a cell shows {MAX_LINES} lines. Does {owner.label()} print in a loop without a "
                "rospy.sleep() or rate.sleep()?"
            )

    def _label(self, owner: ScriptOutput) -> str:
        return super()._label(owner) if self._several_print(owner) else ""

    def say(self, text: str) -> None:
        """Write a line of the notebook itself, after ending an unfinished line."""
        if self._open is not None:
            self.stdout.write("\n")
            self._open = None
        self.stdout.write(f"{text}\n")
        self.stdout.flush()

    def attach(self) -> None:
        """Write to the process's present streams."""
        for stream in self._streams:
            stream.attach()

    def mute(self, *, muted: bool) -> None:
        """Discard everything that is written from now on, or stop discarding."""
        for stream in self._streams:
            stream.is_muted = muted


class TypedFeed(Feed):
    """Lines that the reader types below the cell in which time passes; graph time stops meanwhile.

    ``ask`` calls a function in the context of that cell. An interrupt ends the cell, and the script asks again when
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
            except NotImplementedError as error:  # raised by IPython where there is no input
                raise ScriptError(
                    f"the script asks for input, but there is no keyboard here: {self._advice}"
                ) from error
            except KeyboardInterrupt:
                signal.raise_signal(signal.SIGINT)  # ends the cell that drives the graph
                who.pause("standard input", _A_MOMENT_NS)

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:  # noqa: ARG002
        return True


def _line() -> str:
    """Read a line from the reader; an interrupt ends this at once."""
    if threading.current_thread() is not threading.main_thread():
        return builtins.input()
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return builtins.input()
    finally:
        signal.signal(signal.SIGINT, before)
