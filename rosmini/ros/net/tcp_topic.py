"""Both sides of a topic over TCPROS (http://wiki.ros.org/ROS/TCPROS)."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.scheduler import Scheduler

    from .tcp_stream import Stream

BATCH_BYTES = 64 * 1024
"""Approximate number of bytes that a publisher writes at once."""

UNBOUNDED = 64 * 1024 * 1024
"""Maximum backlog for a slow subscriber without a queue size [bytes]; then the oldest messages are dropped."""

BATCH_MESSAGES = 1000
"""Maximum number of messages that a subscriber hands over at once."""

LENGTH_SIZE = 4
"""Size of the length before each message [bytes]."""

HELD = 1024 * 1024
"""Backlog of a subscriber without a queue size at which reading stops [bytes]."""

HELD_MESSAGES = 100_000
"""Backlog at which reading stops [messages]; a message without fields has no bytes."""


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
        if len(self._waiting) >= size if size else self._queued - self._taken >= BATCH_BYTES:
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
        while self._waiting and length < BATCH_BYTES:
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


class TopicInlet:
    """Receives the frames of one publisher; they stay bytes until callbacks have processed earlier ones."""

    def __init__(
        self, scheduler: Scheduler, stream: Stream, receiver: Connection, first: list[bytes], on_cut: Callable[[], None]
    ) -> None:
        self._scheduler = scheduler
        self._on_cut = on_cut
        self._stream = stream
        self._receiver = receiver
        self._frames: deque[bytes] = deque()
        self._bytes = 0
        self._is_due = False
        self._is_paused = False
        self._has_ended = False
        self._error: Exception | None = None
        self._is_over = False
        receiver.on_drained = self._more
        stream.on_frames = self._arrived
        stream.on_end = self._ended
        stream.share()
        if first:
            self._arrived(first)
        stream.resume()

    # -- in the I/O thread, or in an idle scheduler's ------------------------------------------------------------

    def _arrived(self, frames: list[bytes]) -> None:
        size = self._receiver.queue_size
        with self._stream.lock:
            self._frames.extend(frames)
            self._bytes += sum(map(len, frames))
            while size and len(self._frames) > size:
                self._bytes -= len(self._frames.popleft())
                self._receiver.dropped += 1
            if (self._bytes > HELD or len(self._frames) > HELD_MESSAGES) and not size:
                self._is_paused = True
                self._stream.pause()
        self._wake()

    def _ended(self, error: Exception | None) -> None:
        self._has_ended, self._error = True, error
        self._wake()

    def _wake(self) -> None:
        if not self._is_due:
            self._is_due = True
            self._scheduler.call_soon(self._take)

    # -- in the scheduler's thread -------------------------------------------------------------------------------

    def _more(self) -> None:
        """Hand over the messages held back, once callbacks have processed the rest."""
        if not self._is_due and (self._frames or self._has_ended):
            self._is_due = True
            self._scheduler.ready.append(self._take)

    def _take(self) -> None:
        self._is_due = False
        if self._is_over:
            return
        receiver, frames = self._receiver, self._frames
        size, waiting = receiver.queue_size, receiver.incoming
        while size and waiting and len(waiting) + len(frames) > size:
            waiting.popleft()
            receiver.dropped += 1
        if waiting:
            return  # called again once these are processed
        batch: list[bytes] = []
        with self._stream.lock:
            while frames and len(batch) < BATCH_MESSAGES:
                batch.append(frames.popleft())
                self._bytes -= len(batch[-1])
            go_on = self._is_paused and self._bytes <= HELD and len(frames) <= HELD_MESSAGES
            self._is_paused = self._is_paused and not go_on
        if go_on:
            self._stream.resume()
        if batch:
            decode = receiver.message_class._decode
            try:
                messages = [decode(frame) for frame in batch]
            except Exception as error:
                self._fail(error, len(batch))
                return
            receiver.bytes_received += sum(map(len, batch)) + LENGTH_SIZE * len(batch)
            receiver.deliver(messages)
        elif self._has_ended:
            self._finish()
        if frames or (self._has_ended and not self._is_over and not waiting):
            self._more()

    def _fail(self, error: Exception, count: int) -> None:
        self._is_over = True
        self._stream.abort()
        name = self._receiver.message_class._type
        problem = DeserializationError(f"what it sent ({count} messages at once) is no {name}: {error}")
        problem.__cause__ = error
        self._receiver.failed(problem)

    def _finish(self) -> None:
        self._is_over = True
        if self._error is None or isinstance(self._error, OSError):
            if self._stream.is_cut:
                self._on_cut()
            self._receiver.closed()
        else:
            self._receiver.failed(self._error)

    def close(self) -> None:
        """Close from the subscriber's side."""
        self._is_over = True
        self._receiver.on_drained = None
        self._stream.abort()
