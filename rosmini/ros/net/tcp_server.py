"""The port of a node that accepts subscribers and service clients."""

from __future__ import annotations

import asyncio
import socket
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING

from rosmini.core.errors import DeserializationError, TransportInitError
from rosmini.core.graph.headers import decode_fields, encode_header

from .frames import FrameReader
from .sockets import listen, prepare
from .tcp_service import TcpClient
from .tcp_stream import Stream
from .tcp_topic import TcpSender
from .xmlrpc_text import NOT_XML

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.node import Node
    from rosmini.core.graph.scheduler import Scheduler
    from rosmini.core.graph.transport import Header

    from .io_thread import IoThread

    Warn = Callable[..., None]

HANDSHAKE_S = 30.0
"""Handshake timeout [s]."""

WAITING = 128
"""Maximum number of connections in the handshake; beyond that, the oldest is closed."""

PAUSE_S = 1.0
"""How long no connection is accepted after the system has refused one [s]."""


class TcpServer:
    """Listens for one node from its creation on. Raises ``OSError`` at once on failure."""

    def __init__(
        self, io: IoThread, scheduler: Scheduler, endpoint: Node, warn: Warn, *, bind: str, port: int = 0
    ) -> None:
        self.io = io
        self.scheduler = scheduler
        self.endpoint = endpoint
        self.warn = warn
        self._socket = listen(bind, port)
        self.port: int = self._socket.getsockname()[1]
        self._is_closed = False
        self.waiting: dict[_Arrival, None] = {}
        """Connections in the handshake, in order of arrival."""
        io.call(self._begin)

    def _begin(self) -> None:
        if not self._is_closed:
            self.io.closers[self._end] = None
            asyncio.get_running_loop().add_reader(self._socket, self._accept)

    def close(self) -> None:
        """Stop listening; connections remain. May be called repeatedly and from any thread."""
        if not self._is_closed:
            self._is_closed = True
            if self.io.runs:
                self.io.call(self._end)

    def _end(self) -> None:
        self.io.closers.pop(self._end, None)
        self._is_closed = True
        if self._socket.fileno() >= 0:
            asyncio.get_running_loop().remove_reader(self._socket)
            self._socket.close()

    def _accept(self) -> None:
        try:
            sock, peer = self._socket.accept()
        except (BlockingIOError, InterruptedError, ConnectionAbortedError):
            return
        except OSError as error:
            loop = asyncio.get_running_loop()
            loop.remove_reader(self._socket)
            loop.call_later(PAUSE_S, self._begin)
            name = self.endpoint.name
            self.warn(f"{name} takes no connections for a moment: {error}", (name, "accept"))
            return
        with suppress(OSError):  # it has gone again
            prepare(sock)
        self.waiting[_Arrival(self, sock, peer[0])] = None
        if len(self.waiting) > WAITING:
            next(iter(self.waiting)).give_up(f"{WAITING} others wait, too")

    def complain(self, host: str, reason: str, cause: str) -> None:
        """Log why a connection is closed, but not repeatedly for the same host and cause."""
        name = self.endpoint.name
        self.warn(f"{name} closed a connection from {host}: {reason}", (name, host, cause))


class _Arrival:
    """A connection whose header has not arrived."""

    def __init__(self, server: TcpServer, sock: socket.socket, host: str) -> None:
        self._server = server
        self._host = host
        self._frames = FrameReader()
        self._stream = stream = Stream(server.io, sock, self._frames)
        self._answer: deque[bytes] = deque()
        stream.source = self._next
        stream.on_frames = self._arrived
        stream.on_end = self._ended
        self._timer = asyncio.get_running_loop().call_later(
            HANDSHAKE_S, self.give_up, f"nothing more within {HANDSHAKE_S:g} s"
        )
        stream.start()

    def _next(self) -> bytes:
        return self._answer.popleft() if self._answer else b""

    def give_up(self, reason: str) -> None:
        """Close the connection, because no header has come."""
        self._settle()
        self._stream.abort()
        self._server.complain(self._host, f"it sent no header, and {reason}", "silence")

    def _settle(self) -> None:
        """Stop waiting for the header."""
        self._timer.cancel()
        self._server.waiting.pop(self, None)

    def _ended(self, error: Exception | None) -> None:
        self._settle()
        if isinstance(error, DeserializationError):
            self._server.complain(self._host, str(error), "header")

    def _arrived(self, frames: list[bytes]) -> None:
        self._settle()
        self._stream.pause()
        try:
            header = decode_fields(frames[0])
        except DeserializationError as error:
            self._garbled(str(error))
            return
        if "topic" in header:
            take = self._take_subscriber
        elif "service" in header:
            take = self._take_client
        else:
            self._garbled("no topic or service name detected")
            return
        self._server.scheduler.call_soon_threadsafe(lambda: take(header, frames[1:]))

    def _garbled(self, reason: str) -> None:
        self._server.complain(self._host, reason, "header")
        self._refuse({"error": reason})

    def _refuse(self, answer: Header) -> None:
        with self._stream.lock:
            self._answer.append(encode_header(answer))
        self._stream.close()

    # -- in the scheduler's thread -------------------------------------------------------------------------------

    def _take_subscriber(self, header: Header, more: list[bytes]) -> None:  # noqa: ARG002 - it ought to be silent
        server, stream = self._server, self._stream
        caller = NOT_XML.sub("?", header.get("callerid", "unknown"))  # others learn it over XML-RPC
        sender = TcpSender(server.scheduler, stream, caller)
        try:
            reply = server.endpoint.accept_subscriber(header, sender)
        except TransportInitError as error:
            stream.source = self._next
            self._refuse({**error.header, "error": str(error)})
            return
        self._frames.is_deaf = True  # a subscriber has nothing more to say
        sender.open(encode_header(reply))
        stream.resume()

    def _take_client(self, header: Header, more: list[bytes]) -> None:
        server, stream = self._server, self._stream
        try:
            session = server.endpoint.accept_client(header)
        except TransportInitError as error:
            self._refuse({"error": str(error)})
            return
        client = TcpClient(server.scheduler, stream, session, header, more)
        client.open(encode_header(session.header), is_probe=header.get("probe") == "1")
        stream.resume()
