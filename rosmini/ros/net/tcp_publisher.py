"""Publisher side of a topic over TCPROS (http://wiki.ros.org/ROS/TCPROS)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.scheduler import Scheduler

    from .tcp_stream import Stream

BATCH = 64 * 1024
"""Approximate number of bytes written at once."""

UNBOUNDED = 64 * 1024 * 1024
"""Maximum backlog for a slow subscriber without a queue size [bytes]; then the oldest messages are dropped."""


class TcpSender:
    """Sends serialised messages to one subscriber in batches; drops the oldest if it reads slowly."""

    protocol = "TCPROS"

    def __init__(self, scheduler: Scheduler, stream: Stream, destination: str) -> None:
        self._scheduler = scheduler
        self._stream = stream
        self._header: bytes | None = None
        self._is_open = False
        self._is_closed = False
        self._waiting: deque[bytes] = deque()
        self._queued = 0
        self._taken = 0
        self._is_due = False
        self.destination = destination
        self.info = stream.describe()
        self.on_closed: Callable[[], None] = _nothing
        self.on_dropped: Callable[[], None] = _nothing
        self.sent = 0
        """Number of messages sent, including dropped ones."""
        self.dropped = 0
        """Number of messages dropped because the subscriber reads too slowly."""
        stream.source = self._next

    def open(self, header: bytes) -> None:
        """Send the header, then the queued messages."""
        self._header = header
        self._is_open = True
        self._stream.on_end = self._ended
        self._stream.flush()

    def send(self, packet: Any, size: int | None) -> None:
        """Send a message now if it is the first of this event, since the rest may take long, or else in the next event.

        Several messages are written together, and earlier only if the oldest would be dropped otherwise.
        """
        if self._is_closed:
            return
        self.sent += 1
        if len(self._waiting) >= size if size else self._queued - self._taken >= BATCH:
            self._make_room(size)
        self._waiting.append(packet)
        self._queued += len(packet)
        if not self._is_due:
            self._is_due = True
            self._scheduler.ready.append(self._flush)
            if self._is_open:
                self._stream.flush()

    def _make_room(self, size: int | None) -> None:
        """Write the queued messages, and drop the oldest if that does not free enough space."""
        if self._is_open:
            self._stream.flush()
        waiting, before = self._waiting, self.dropped
        with self._stream.lock:
            while waiting and (len(waiting) >= size if size else self._queued - self._taken > UNBOUNDED):
                self._taken += len(waiting.popleft())
                self.dropped += 1
        if self.dropped and not before:
            self.on_dropped()

    def _flush(self) -> None:
        self._is_due = False
        if self._is_open and self._waiting:
            self._stream.flush()

    def _next(self) -> bytes:
        """Return the next bytes for the socket, about a batch, with the stream's lock held."""
        if self._header is not None:
            header, self._header = self._header, None
            return header
        if not self._is_open or not self._waiting:
            return b""
        packets, length = [], 0
        while self._waiting and length < BATCH:
            packets.append(self._waiting.popleft())
            length += len(packets[-1])
        self._taken += length
        return packets[0] if len(packets) == 1 else b"".join(packets)

    def close(self) -> None:
        """Close from the publisher's side, after sending the queued data."""
        self._is_closed = True
        self._stream.close()

    def _ended(self, _error: Exception | None) -> None:
        """Handle a connection that the subscriber closed or that broke; in the I/O thread."""
        self._scheduler.call_soon_threadsafe(self._handle_close)

    def _handle_close(self) -> None:
        if not self._is_closed:
            self._is_closed = True
            self._waiting.clear()
            self.on_closed()


def _nothing() -> None:
    """Do nothing; the default callback."""
