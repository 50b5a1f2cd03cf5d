"""The publisher's end of a topic on TCPROS (http://wiki.ros.org/ROS/TCPROS)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.scheduler import Scheduler
    from rosmini.core.graph.transport import DirectReceiver

    from .tcp_stream import Stream

BATCH = 64 * 1024
"""About so many bytes are written at once."""

UNBOUNDED = 64 * 1024 * 1024
"""So many bytes wait for a slow subscriber of a publisher without a queue size; then the oldest are dropped."""


class TcpSender:
    """Sends the bytes of messages to one subscriber, in batches; one that reads slowly loses the oldest."""

    protocol = "TCPROS"
    wants_bytes = True
    receiver: DirectReceiver | None = None

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
        """How many messages were sent, dropped ones included."""
        self.dropped = 0
        """The number of messages dropped because the subscriber reads too slowly."""
        stream.source = self._next

    def open(self, header: bytes) -> None:
        """Send the header, and then what has been queued."""
        self._header = header
        self._is_open = True
        self._stream.on_end = self._ended
        self._stream.flush()

    def send(self, packet: Any, size: int | None) -> None:
        """Send a message now if it is the first of this event, for what follows may take long; else in the next event.

        Many together are written at once, and earlier only where the oldest would have to go.
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
        """Write what waits, and drop the oldest where that was not enough."""
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
        """Return the next bytes for the socket: about a batch. With the stream's lock held."""
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
        """Close from the publisher's side, after what was sent."""
        self._is_closed = True
        self._stream.close()

    def _ended(self, _error: Exception | None) -> None:
        """The subscriber has closed the connection, or it broke. In the I/O thread."""
        self._scheduler.call_soon_threadsafe(self._tell)

    def _tell(self) -> None:
        if not self._is_closed:
            self._is_closed = True
            self._waiting.clear()
            self.on_closed()


def _nothing() -> None:
    """Do nothing: what is called when nobody has asked to be."""
