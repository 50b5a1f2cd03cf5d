"""Client and server side of a service over TCPROS: a request is answered by an ok byte and a response, or an error."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler
    from rosmini.core.graph.service import Session
    from rosmini.core.graph.transport import Header

    from .tcp_stream import Stream


Reply = Callable[[Any, str | None], None]

BROKEN = "transport error completing service call: unable to receive data from sender, check sender's logs for details"


class TcpServiceLink:
    """A service as its client sees it: sends requests, whose answers arrive in the same order."""

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


class TcpClient:
    """A client of a service as its server sees it; requests are handled one after another."""

    def __init__(
        self, scheduler: Scheduler, stream: Stream, session: Session, header: Header, first: list[bytes]
    ) -> None:
        self._scheduler = scheduler
        self._stream = stream
        self._session = session
        self._is_persistent = header.get("persistent", "").lower() in ("1", "true")
        self._requests = deque(first)
        self._answers: deque[bytes] = deque()
        self._is_busy = False
        self._is_paused = False
        self._is_stuck = False
        self._is_over = False
        stream.source = self._next
        stream.on_frames = self._arrived
        stream.on_end = self._ended
        stream.share()

    def open(self, header: bytes, *, is_probe: bool) -> None:
        """Send the header, then answer requests; a probe gets only the header."""
        self._answers.append(header)
        self._stream.flush()
        if is_probe:
            self._close()
        elif self._requests:
            self._handle()

    # -- in the I/O thread, or in an idle scheduler's ------------------------------------------------------------

    def _arrived(self, frames: list[bytes]) -> None:
        self._requests.extend(frames)
        if len(self._requests) > 1:  # clients that wait for each answer are never paused
            self._stream.pause()
            self._is_paused = True
        self._scheduler.call_soon(self._handle)

    def _ended(self, _error: Exception | None) -> None:
        self._scheduler.call_soon_threadsafe(self._gone)

    # -- in the scheduler's thread -------------------------------------------------------------------------------

    def _handle(self) -> None:
        if self._is_busy or self._is_over or self._is_stuck:
            return
        if not self._requests:
            if self._is_paused:
                self._is_paused = False
                self._stream.resume()
            return
        self._is_busy = True
        request_class = self._session.service_class._request_class
        try:
            request = request_class._decode(self._requests.popleft())
        except Exception as error:
            self._answer(None, f"error processing request: these bytes are no {request_class._type}: {error}")
        else:
            self._session.handle(request, self._answer)

    def _answer(self, response: Any, problem: str | None) -> None:
        self._is_busy = False
        if self._is_over:
            return
        body = problem.encode() if problem is not None else response._encode(response)
        lead = b"\x00" if problem is not None else b"\x01"
        with self._stream.lock:
            self._answers.append(b"".join((lead, len(body).to_bytes(4, "little"), body)))
        self._stream.flush()
        if not self._is_persistent:
            self._close()
            return
        with self._stream.lock:  # who does not read the answer gets no other one
            self._is_stuck = self._stream.is_blocked
        self._scheduler.ready.append(self._handle)

    def _close(self) -> None:
        self._stream.close()
        self._gone()

    def _gone(self) -> None:
        if not self._is_over:
            self._is_over = True
            self._session.close()

    def _next(self) -> bytes:
        if self._answers:
            return self._answers.popleft()
        if self._is_stuck:
            self._is_stuck = False
            self._scheduler.call_soon_threadsafe(self._handle)
        return b""
