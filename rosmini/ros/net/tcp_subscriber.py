"""Subscriber side of a topic over TCPROS: receives frames, and decodes those that are needed."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.scheduler import Scheduler

    from .tcp_stream import Stream

BATCH = 1000
"""Maximum number of messages handed over at once."""

LENGTH_SIZE = 4
"""Size of the length before each message [bytes]."""

HELD = 1024 * 1024
"""Backlog of a subscriber without a queue size at which reading stops [bytes]."""


HELD_MESSAGES = 100_000
"""Backlog at which reading stops [messages]; a message without fields has no bytes."""


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
            while frames and len(batch) < BATCH:
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
