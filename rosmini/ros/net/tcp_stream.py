"""A connected socket in the I/O thread that reads frames and writes bytes without blocking."""

from __future__ import annotations

import asyncio
import socket
import threading
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from .frames import FrameReader
    from .idle_reads import IdleReads
    from .io_thread import IoThread

LINGER_S = 2.0
"""How long a closed connection may take to deliver data already sent [s]."""

READS = 16
"""Maximum number of consecutive reads of a socket before others are served."""


class Stream:
    """Reads frames in the I/O thread, where it is created; data that the socket refuses at once is written there.

    A ``shared`` stream is read in the scheduler's thread while it is idle: ``on_frames`` may then be called there.

    ``source`` returns the next bytes to send, or b"" if none; it is called with :attr:`lock` held, and code that
    fills it takes the lock too. ``on_frames`` and ``on_end`` are called in the I/O thread; ``on_end`` once, with the
    error, or None if the peer closed the connection, and not after :meth:`close`.
    """

    def __init__(self, io: IoThread, sock: socket.socket, frames: FrameReader) -> None:
        self._io = io
        self._loop = asyncio.get_running_loop()
        self._socket = sock
        self._frames = frames
        self.lock = threading.Lock()
        self.source: Callable[[], bytes] = bytes
        self.on_frames: Callable[[list[bytes]], None] = _ignore
        self.on_end: Callable[[Exception | None], None] = _ignore
        self._rest = memoryview(b"")
        self._is_blocked = False
        self._is_closing = False
        self._is_shut = False
        self._reads = False
        self._is_shared = False
        self._idle: IdleReads | None = None
        sock.setblocking(False)
        self._call(self._register)

    @property
    def is_cut(self) -> bool:
        """True if the received data ends in the middle of a frame."""
        return self._frames.is_cut

    def describe(self, host: str | None = None) -> str:
        """Return the description for ``getBusInfo``, in ROS's words; ``host`` is the peer's name for itself."""
        try:
            here, there = self._socket.getsockname(), self._socket.getpeername()
        except OSError:
            return ""  # closed meanwhile
        number = self._socket.fileno()
        return f"TCPROS connection on port {here[1]} to [{host or there[0]}:{there[1]} on socket {number}]"

    def _register(self) -> None:
        if not self._is_shut:
            self._io.closers[self._shut] = None

    # -- reading, in the I/O thread ------------------------------------------------------------------------------

    def share(self) -> None:
        """Let an idle scheduler read it too; may be called from any thread while nothing reads it."""
        self._is_shared = True

    def resume(self) -> None:
        """Start or resume reading; may be called from any thread."""
        self._call(self.start)

    def start(self) -> None:
        """Start or resume reading."""
        if self._is_shut or self._reads:
            return
        self._reads = True
        if self._is_shared and self._idle is None:
            self._idle = self._io.idle
        if self._idle is not None:
            self._idle.add(self._socket, self._readable)
        else:
            self._loop.add_reader(self._socket, self._readable)

    def pause(self) -> None:
        """Pause reading: the peer has to wait."""
        if self._reads:
            self._reads = False
            if self._idle is not None:
                self._idle.remove(self._socket)
            else:
                self._loop.remove_reader(self._socket)

    def _readable(self) -> None:
        """Read the available data, but at most so much that others need not wait long."""
        for _ in range(READS):
            wanted = self._frames.wanted
            try:
                data = self._socket.recv(wanted)
            except (BlockingIOError, InterruptedError):
                return
            except OSError as error:
                self._stop(error)
                return
            if not data:
                self._stop(None)
                return
            if not self._is_closing:  # later data is discarded, so that the peer can read our last message
                try:
                    frames = self._frames.feed(data)
                except DeserializationError as error:
                    self._stop(error)
                    return
                if frames:
                    self.on_frames(frames)
            if len(data) < wanted or not self._reads or self._is_shut:
                return

    def _stop(self, error: Exception | None) -> None:
        """Stop reading, and end the stream in the I/O thread."""
        if self._idle is None:
            self._end(error)
        else:
            self.pause()
            self._call(partial(self._end, error))

    def _end(self, error: Exception | None) -> None:
        tell = not self._is_closing and not self._is_shut
        self._shut()
        if tell:
            self.on_end(error)

    def _shut(self) -> None:
        """Close the socket; I/O thread only."""
        self._io.closers.pop(self._shut, None)
        with self.lock:
            if self._is_shut:
                return
            self._is_shut = True
        self.pause()
        self._loop.remove_writer(self._socket)
        self._socket.close()

    # -- writing, in any thread ----------------------------------------------------------------------------------

    @property
    def is_blocked(self) -> bool:
        """True while the peer accepts no more data."""
        return self._is_blocked

    def flush(self) -> None:
        """Send data from the source as far as the socket accepts it; the rest follows automatically."""
        with self.lock:
            if not self._is_blocked:
                self._pump()

    def _pump(self) -> None:
        """Write until nothing is left or the socket accepts no more, with the lock held."""
        while not self._is_shut:
            if not self._rest:
                self._rest = memoryview(self.source())
                if not self._rest:
                    if self._is_closing:
                        self._call(self._finish)
                    return
            try:
                self._rest = self._rest[self._socket.send(self._rest) :]
            except (BlockingIOError, InterruptedError):
                if not self._is_blocked:
                    self._is_blocked = True
                    self._call(self._wait_to_write)
                return
            except OSError as error:
                self._call(partial(self._end, error))
                return

    def _wait_to_write(self) -> None:
        if not self._is_shut:
            self._loop.add_writer(self._socket, self._writable)

    def _writable(self) -> None:
        with self.lock:
            self._is_blocked = False
            self._pump()
            done = not self._is_blocked
        if done and not self._is_shut:
            self._loop.remove_writer(self._socket)

    def close(self) -> None:
        """Close the connection after sending, without a callback; may be called repeatedly and from any thread."""
        with self.lock:
            if self._is_closing or self._is_shut:
                return
            self._is_closing = True
            if not self._is_blocked:
                self._pump()
        self._call(self._linger)

    def _linger(self) -> None:
        """Close completely when the peer has read everything, or after a timeout."""
        if not self._is_shut:
            self.start()
            self._loop.call_later(LINGER_S, self._shut)

    def _finish(self) -> None:
        """Signal the end of data to the peer, which then closes its side too."""
        if not self._is_shut:
            with suppress(OSError):
                self._socket.shutdown(socket.SHUT_WR)
            self.start()

    def abort(self) -> None:
        """Close at once and discard unsent data; may be called from any thread."""
        self._is_closing = True
        self._call(self._shut)

    def _call(self, function: Callable[[], None]) -> None:
        try:
            self._loop.call_soon_threadsafe(function)
        except RuntimeError:  # the loop has ended
            self._is_shut = True
            self._socket.close()


def _ignore(_: object) -> None:
    """Do nothing; the default callback."""
