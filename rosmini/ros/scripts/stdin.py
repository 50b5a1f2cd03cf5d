"""Standard input of scripts, from the terminal or supplied; reading parks the lane and never stops the graph."""

from __future__ import annotations

import codecs
import importlib
import io
import os
import select
import sys
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Any, Protocol, TextIO

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rosmini.core.graph.scheduler import Scheduler

KEY_S = 0.01
"""Period at which the console of Windows is polled for a key [s]."""

PRETENDED_FD = 0x7FFF_0000
"""Descriptor number of supplied input; no real file has it, so using it elsewhere fails."""


class Blocker(Protocol):
    """Waits on behalf of a script, in such a way that the wait can be ended."""

    def pause(self, reason: str, timeout_ns: int | None) -> bool:
        """Wait for ``timeout_ns`` of graph time; see :meth:`ScriptContext.pause`."""


class Feed:
    """A source of text with a buffer."""

    def __init__(self) -> None:
        self._text = ""
        self._ended = False

    def readline(self, who: Blocker, limit: int = -1) -> str:
        """Return the next line with its end, the rest without one, or "" at the end."""
        while "\n" not in self._text and not self._ended and not 0 <= limit <= len(self._text):
            self._fill(who)
        end = self._text.find("\n") + 1 or len(self._text)
        return self._take(min(end, limit) if limit >= 0 else end)

    def read(self, who: Blocker, size: int = -1) -> str:
        """Return ``size`` characters, or all until the end."""
        while not self._ended and not 0 <= size <= len(self._text):
            self._fill(who)
        return self._take(len(self._text) if size < 0 else size)

    def ready(self, who: Blocker, timeout_ns: int | None) -> bool:
        """Wait until input (or its end) can be read, up to ``timeout_ns``; return True if it can.

        After the end was read, further calls wait for the whole timeout, as if no key was pressed: or else a loop that
        waits for keys would run for ever at one instant of simulated time.
        """
        if self._text:
            return True
        if self._ended:
            if timeout_ns:
                who.pause("standard input, which has ended", timeout_ns)
            return True
        return self._await(who, timeout_ns)

    def _take(self, count: int) -> str:
        taken, self._text = self._text[:count], self._text[count:]
        return taken

    def _fill(self, who: Blocker) -> None:
        """Get more text, or record the end."""
        raise AssertionError(who)

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:
        raise AssertionError(who, timeout_ns)

    def isatty(self) -> bool:
        """Return True if it is a terminal."""
        return False

    def fileno(self) -> int:
        """Return the descriptor."""
        return PRETENDED_FD

    def close(self) -> None:
        """Release waiting readers."""


class SuppliedFeed(Feed):
    """Text that is known beforehand: all at once, or in pieces that arrive at given times [s] after the start."""

    def __init__(self, scheduler: Scheduler, pieces: str | Iterable[tuple[float, str]]) -> None:
        super().__init__()
        timed = [(0.0, pieces)] if isinstance(pieces, str) else list(pieces)
        self._scheduler = scheduler
        start = scheduler.now_ns()
        self._pieces = deque((start + round(at * 1e9), text) for at, text in timed)

    def _arrive(self) -> None:
        now = self._scheduler.now_ns()
        while self._pieces and self._pieces[0][0] <= now:
            self._text += self._pieces.popleft()[1]
        self._ended = not self._pieces

    def _fill(self, who: Blocker) -> None:
        before = len(self._text)
        self._arrive()
        if len(self._text) == before and self._pieces:
            who.pause("standard input", self._pieces[0][0] - self._scheduler.now_ns())

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:
        self._arrive()
        if self._text or self._ended:
            return True
        until = self._pieces[0][0] - self._scheduler.now_ns()
        wait = until if timeout_ns is None else min(until, timeout_ns)
        if wait > 0:
            who.pause("standard input", wait)
        self._arrive()
        return bool(self._text) or self._ended


class HostFeed(Feed):
    """The host's standard input, shared by the scripts of a run: the first reader gets the next line."""

    def __init__(self, scheduler: Scheduler, stream: TextIO) -> None:
        super().__init__()
        self._scheduler = scheduler
        self._stream = stream
        try:
            self._fd: int = stream.fileno()
        except (OSError, AttributeError, ValueError):
            self._fd = PRETENDED_FD
        self._reading = False
        self._decoder = io.IncrementalNewlineDecoder(None, translate=True)
        encoding = getattr(stream, "encoding", None) or "utf-8"
        self._bytes = codecs.getincrementaldecoder(encoding)("replace")
        self._stop: tuple[int, int] | None = None
        self._selecting = 0
        self._closed = False
        self._lock = threading.Lock()

    def isatty(self) -> bool:
        """Return True if it is a terminal."""
        return self._stream.isatty()

    def fileno(self) -> int:
        """Return the descriptor."""
        return self._fd

    def _fill(self, who: Blocker) -> None:
        known = self._text
        while self._reading:  # another script is at it
            who.pause("standard input, which another script reads", 10_000_000)
        if self._text != known or self._ended:
            return
        self._reading = True
        try:
            text = self._scheduler.in_thread(self._read_some)
        finally:
            self._reading = False
        if text:
            self._text += text
        else:
            self._ended = True

    def _read_some(self) -> str:
        if self._fd == PRETENDED_FD:
            return self._stream.readline()
        while True:
            if not self._selected(None):
                return ""
            data = os.read(self._fd, 4096)
            text = self._decoder.decode(self._bytes.decode(data, final=not data))
            if text or not data:
                return text

    def _selected(self, timeout: float | None) -> bool:
        """Wait for the descriptor; return False after the timeout or if the feed was closed."""
        if os.name == "nt":  # select() there knows sockets only
            return True
        with self._lock:
            if self._closed:
                return False
            if self._stop is None:
                self._stop = os.pipe()
            self._selecting += 1
        try:
            return self._fd in select.select([self._fd, self._stop[0]], [], [], timeout)[0]
        finally:
            with self._lock:
                self._selecting -= 1
                self._close_pipe()

    def _close_pipe(self) -> None:
        if self._closed and not self._selecting and self._stop is not None:
            for descriptor in self._stop:
                os.close(descriptor)
            self._stop = None

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:
        if self._fd == PRETENDED_FD or os.name == "nt" or self._selected(0):
            return True
        if self._scheduler.simulated and timeout_ns is not None:
            if timeout_ns > 0:
                who.pause("standard input", timeout_ns)
            return self._selected(0)
        seconds = None if timeout_ns is None else timeout_ns / 1e9 / self._scheduler.rate
        return seconds != 0 and self._scheduler.in_thread(lambda: self._selected(seconds))

    def close(self) -> None:
        """Release the helper threads that are still reading."""
        with self._lock:
            self._closed = True
            if self._stop is not None and self._selecting:
                os.write(self._stop[1], b"x")
            self._close_pipe()


class Keyboard(Protocol):
    """The functions used from the module ``msvcrt``."""

    def kbhit(self) -> bool:
        """Return True if a key is waiting to be read."""

    def getwch(self) -> str:
        """Return the next key."""


class ConsoleFeed(HostFeed):
    """The console of Windows: lines as Python reads them, or single keys once a script asks for them."""

    def __init__(self, scheduler: Scheduler, stream: TextIO, keyboard: Keyboard) -> None:
        super().__init__(scheduler, stream)
        self._keyboard = keyboard
        self.takes_keys = False
        """True after ``tty.setraw`` and similar calls, and while ``msvcrt`` is used."""

    def _read_some(self) -> str:
        if not self.takes_keys:
            return self._stream.readline()
        while not self._closed:
            if self._keyboard.kbhit():
                return self._keyboard.getwch()
            time.sleep(KEY_S)  # in a thread of its own; nothing notifies it of a key
        return ""

    def _await(self, who: Blocker, timeout_ns: int | None) -> bool:
        if not self.takes_keys or self._keyboard.kbhit():
            return True
        if self._scheduler.simulated and timeout_ns is not None:
            if timeout_ns > 0:
                who.pause("a key", timeout_ns)
            return self._keyboard.kbhit()
        end = None if timeout_ns is None else self._scheduler.now_ns() + timeout_ns
        while not self._keyboard.kbhit():
            if end is not None and self._scheduler.now_ns() >= end:
                return False
            who.pause("a key", int(KEY_S * 1e9))
        return True


class ScriptInput(io.TextIOBase):
    """``sys.stdin`` of one script."""

    def __init__(self, feed: Feed, who: Blocker, before_read: Callable[[], None]) -> None:
        super().__init__()
        self.feed = feed
        self._who = who
        self._before_read = before_read
        self.name = "<stdin>"
        self.mode = "r"

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """The encoding of the text."""
        return "utf-8"

    def readable(self) -> bool:
        """Return True."""
        return True

    def isatty(self) -> bool:
        """Return True if it is a terminal."""
        return self.feed.isatty()

    def fileno(self) -> int:
        """Return the host's descriptor, or an invalid number for supplied input."""
        return self.feed.fileno()

    def readline(self, size: int | None = -1) -> str:  # type: ignore[override]
        """Return the next line; the graph runs meanwhile."""
        self._before_read()
        return self.feed.readline(self._who, -1 if size is None else size)

    def read(self, size: int | None = -1) -> str:
        """Return ``size`` characters, or all."""
        self._before_read()
        return self.feed.read(self._who, -1 if size is None else size)

    def ready(self, timeout_ns: int | None) -> bool:
        """Return True if input can be read within ``timeout_ns`` of graph time."""
        self._before_read()
        return self.feed.ready(self._who, timeout_ns)


def make_feed(scheduler: Scheduler, stdin: Any) -> Feed:
    """Return the feed for ``stdin``: a text, timed pieces of text, a file, or None for the host's."""
    if stdin is None:
        return _host_feed(scheduler, sys.stdin) if sys.stdin is not None else SuppliedFeed(scheduler, "")
    if isinstance(stdin, Feed):
        return stdin
    if hasattr(stdin, "readline"):
        return _host_feed(scheduler, stdin)
    return SuppliedFeed(scheduler, stdin)


def _host_feed(scheduler: Scheduler, stream: TextIO) -> HostFeed:
    try:
        keyboard: Any = importlib.import_module("msvcrt")
    except ImportError:
        return HostFeed(scheduler, stream)
    return ConsoleFeed(scheduler, stream, keyboard) if stream.isatty() else HostFeed(scheduler, stream)
