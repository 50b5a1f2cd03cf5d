"""Client side of a service over TCPROS."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler
    from rosmini.core.graph.transport import Header

    from .tcp_stream import Stream

Reply = Callable[[Any, str | None], None]

BROKEN = "transport error completing service call: unable to receive data from sender, check sender's logs for details"


class TcpServiceLink:
    """Sends requests; the answers arrive in the same order."""

    is_remote = True

    def __init__(self, scheduler: Scheduler, stream: Stream, header: Header, service_class: Any) -> None:
        self.header = header
        self._scheduler = scheduler
        self._stream = stream
        self._class = service_class
        self._requests: deque[bytes] = deque()
        self._replies: deque[Reply] = deque()
        self._is_over = False
        stream.source = self._next
        stream.on_frames = self._arrived
        stream.on_end = self._ended
        stream.share()
        stream.resume()

    def call(self, request: Any, reply: Reply) -> None:
        """Send a frozen request."""
        if self._is_over:
            reply(None, BROKEN)
            return
        body = request._encode(request)
        self._replies.append(reply)
        with self._stream.lock:
            self._requests.append(len(body).to_bytes(4, "little") + body)
        self._stream.flush()

    def _next(self) -> bytes:
        return self._requests.popleft() if self._requests else b""

    def _arrived(self, frames: list[bytes]) -> None:
        self._scheduler.call_soon(partial(self._take, frames))

    def _ended(self, error: Exception | None) -> None:
        if isinstance(error, DeserializationError):
            reason = f"transport error completing service call: the response cannot be read: {error}"
        else:
            reason = BROKEN
        self._scheduler.call_soon_threadsafe(partial(self._broken, reason))

    def _take(self, frames: list[bytes]) -> None:
        for frame in frames:
            if not self._replies:
                return  # more answers than requests
            reply = self._replies.popleft()
            if not frame[0]:
                reply(None, frame[1:].decode(errors="replace"))
                continue
            try:
                response = self._class._response_class._decode(frame[1:])
            except Exception as error:
                reply(None, f"transport error completing service call: the response cannot be read: {error}")
            else:
                reply(response, None)

    def _broken(self, reason: str) -> None:
        self._is_over = True
        while self._replies:
            self._replies.popleft()(None, reason)

    def close(self) -> None:
        """Close the connection."""
        self._is_over = True
        self._stream.abort()
