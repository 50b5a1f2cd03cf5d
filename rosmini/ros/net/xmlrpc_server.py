"""XML-RPC server for the Master's API, the Parameter Server's, and each node's slave API."""

from __future__ import annotations

import asyncio
import inspect
from contextlib import contextmanager, suppress
from functools import partial
from http import HTTPStatus
from typing import TYPE_CHECKING, Any, cast

import h11

from rosmini.core.errors import TransportException

from .http import HEAD_LIMIT, read_message, write_message
from .request_check import Refused, RequestCheck
from .sockets import listen
from .xmlrpc_text import Document, XmlRpcFault, encode_answer, encode_fault

if TYPE_CHECKING:
    import socket
    from collections.abc import Awaitable, Callable, Iterable, Iterator

    from .io_thread import IoThread

    Handler = Callable[[str, tuple[Any, ...]], Any | Awaitable[Any]]

PAUSE_S = 1.0
"""How long no connection is accepted after the system has refused one [s]."""

FIRST_S = 30.0
"""How long the first call of a connection may take to arrive [s]."""

IDLE_S = 300.0
"""How long each later call, and reading an answer, may take before the connection is closed [s]."""

WAITING = 256
"""Maximum number of idle connections; beyond that, the one idle for the longest is closed."""

CLIENTS = 1_000
"""Maximum number of clients whose faults are logged, once each."""


class EncodedAnswer(bytes):
    """Document of an answer that a handler has encoded itself."""


class XmlRpcServer:
    """Answers calls at a port of this machine from its creation on; requests that a web page can send are refused.

    Args:
        io: the thread that reads and writes.
        handler: called in that thread with a method's name and the arguments; returns the value, an
            :class:`EncodedAnswer`, or an awaitable of either. It must not block. An :class:`XmlRpcFault` that it
            raises is answered as such, any other exception as fault 1, as rospy does.
        bind: the address to listen on; "" or "0.0.0.0": all addresses of the machine.
        port: 0 for any free port.
        names: names and addresses that the user gave this machine; see
            :class:`~rosmini.ros.net.request_check.RequestCheck`.
        warn: called in that thread with a client's host and the fault of its request: once for each host's
            refused requests, and once for those that are not XML-RPC.

    Raises ``OSError`` at once if the port is in use or the address is not the machine's.

    """

    def __init__(
        self,
        io: IoThread,
        handler: Handler,
        *,
        bind: str = "127.0.0.1",
        port: int = 0,
        names: Iterable[str] = (),
        warn: Callable[[str, str], object] | None = None,
    ) -> None:
        self._handler = handler
        self._check = RequestCheck(names)
        self._io = io
        self._socket = listen(bind, port)
        self.port: int = self._socket.getsockname()[1]
        self._warn = warn
        self._warned: set[tuple[str, bool]] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._waiting: dict[asyncio.Task[None], None] = {}
        """Tasks that wait for a call, the oldest first."""
        self._closed = False
        self.caller = ""
        """Address of the client whose call the handler is answering."""
        io.call(self._begin)

    def _begin(self) -> None:
        if not self._closed:
            self._io.closers[self._end] = None
            asyncio.get_running_loop().add_reader(self._socket, self._accept)
        else:
            self._socket.close()

    def close(self) -> None:
        """Stop listening and close all connections; may be called repeatedly and from any thread."""
        if not self._closed:
            self._closed = True
            if self._io.runs:
                self._io.call(self._end)

    def _end(self) -> None:
        self._closed = True
        self._io.closers.pop(self._end, None)
        if self._socket.fileno() >= 0:
            asyncio.get_running_loop().remove_reader(self._socket)
            self._socket.close()
        for task in self._tasks:
            task.cancel()

    def _accept(self) -> None:
        try:
            sock, peer = self._socket.accept()
        except (BlockingIOError, InterruptedError, ConnectionAbortedError):
            return
        except OSError:  # no descriptors are left: accept the connection later
            loop = asyncio.get_running_loop()
            loop.remove_reader(self._socket)
            loop.call_later(PAUSE_S, self._begin)
            return
        sock.setblocking(False)
        task = asyncio.get_running_loop().create_task(self._serve(sock, peer[0]))
        self._tasks.add(task)
        task.add_done_callback(partial(self._forget, sock))

    def _forget(self, sock: socket.socket, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        sock.close()  # for a task that was ended before it began

    async def _serve(self, sock: socket.socket, host: str) -> None:
        """Answer the calls of one connection, one after another."""
        connection = h11.Connection(h11.SERVER, max_incomplete_event_size=HEAD_LIMIT)
        patience = FIRST_S
        with suppress(OSError, TimeoutError):
            reader, writer = await asyncio.open_connection(sock=sock)
            try:
                while await self._serve_one(connection, reader, writer, host, patience):
                    connection.start_next_cycle()
                    patience = IDLE_S
                writer.close()
                async with asyncio.timeout(IDLE_S):
                    await writer.wait_closed()
            finally:
                writer.transport.abort()

    async def _serve_one(
        self,
        connection: h11.Connection,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        host: str,
        patience: float,
    ) -> bool:
        """Answer the next call; return True if another one may follow."""
        document = Document()
        try:
            with self._its_turn():
                async with asyncio.timeout(patience):
                    head = await read_message(connection, reader, writer, document.feed, self._check.check)
            if head is None:
                return False
            answer = await self._answer(document, host)
            response = _response(HTTPStatus.OK, "", answer)
        except (h11.RemoteProtocolError, TransportException) as error:
            self._complain(host, error)
            if connection.our_state is h11.ERROR:
                return False
            answer = f"{error}\n".encode() if getattr(error, "has_body", True) else b""
            response = _response(_status(error), str(error), answer)
        write_message(connection, writer, response, answer)
        async with asyncio.timeout(IDLE_S):
            await writer.drain()
        return connection.our_state is h11.DONE and connection.their_state is h11.DONE

    def _complain(self, host: str, error: Exception) -> None:
        """Log the fault of a client's request, unless it was logged before."""
        cause = (host, isinstance(error, Refused))
        if self._warn is not None and cause not in self._warned and len(self._warned) < CLIENTS:
            self._warned.add(cause)
            self._warn(host, str(error))

    @contextmanager
    def _its_turn(self) -> Iterator[None]:
        """Register this task as waiting for a call; if there are too many, the oldest are closed."""
        task = cast("asyncio.Task[None]", asyncio.current_task())
        self._waiting[task] = None
        if len(self._waiting) > WAITING:
            next(iter(self._waiting)).cancel()
        try:
            yield
        finally:
            self._waiting.pop(task, None)

    async def _answer(self, document: Document, caller: str) -> bytes:
        arguments, method = document.close()
        if method is None:
            raise TransportException("the document is not a call: it names no method")
        try:
            self.caller = caller
            value = self._handler(method, arguments)
            if inspect.isawaitable(value):
                value = await value
            return value if isinstance(value, EncodedAnswer) else encode_answer(value)
        except XmlRpcFault as fault:
            return encode_fault(fault.code, fault.text)
        except Exception as error:
            return encode_fault(1, f"{type(error)}:{error}")


def _status(error: Exception) -> int:
    """Return the HTTP status for an error."""
    if isinstance(error, Refused):
        return error.status
    return int(getattr(error, "error_status_hint", HTTPStatus.BAD_REQUEST))


def _response(status: int, reason: str, body: bytes) -> h11.Response:
    """Return the head of an answer; ROS's clients show the reason of a refusal."""
    fields = [
        ("Server", "rosmini"),
        ("Content-Type", "text/xml" if status == HTTPStatus.OK else "text/plain; charset=utf-8"),
        ("Content-Length", str(len(body))),
        *([("Allow", "POST")] if status == HTTPStatus.METHOD_NOT_ALLOWED else []),
        *([] if status == HTTPStatus.OK else [("Connection", "close")]),
    ]
    line = "".join(letter if letter.isascii() and letter.isprintable() else "?" for letter in reason)
    return h11.Response(status_code=status, reason=line.encode(), headers=fields)
