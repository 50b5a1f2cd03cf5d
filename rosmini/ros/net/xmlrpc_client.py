"""XML-RPC calls to the Master and to nodes' slave APIs."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import urlsplit

import h11

from rosmini.core.errors import TransportException, TransportTerminated, shown

from .http import HEAD_LIMIT, read_message, write_message
from .sockets import Unreached, connect
from .xmlrpc_text import XmlRpcFault, decode, encode_call

if TYPE_CHECKING:
    from rosmini.core.graph.scheduler import Scheduler

    from .io_thread import IoThread

__all__ = ["TIMEOUT_S", "XmlRpcClient", "XmlRpcFault", "host_and_port"]

TIMEOUT_S = 10.0
"""Timeout of a call, in wall-clock time [s]."""

KEPT = 32
"""Maximum number of connections kept open between calls."""

MAX_REASON_LENGTH = 500
"""Maximum number of characters of a server's reason for refusal in an error."""


class _Open(NamedTuple):
    """A connection to a server."""

    state: h11.Connection
    reader: asyncio.StreamReader
    writer: asyncio.StreamWriter


def host_and_port(uri: str, scheme: str = "http") -> tuple[str, int]:
    """Return host and port of a ROS URI.

    Raises ``TransportException`` for an invalid URI.
    """
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError:
        host = port = None
    if host is None or not port or parts.scheme != scheme:
        raise TransportException(f"{uri!r} is not an address: it should read {scheme}://host:port/")
    return host, port


class XmlRpcClient:
    """Calls methods of servers; connections are kept open between calls if the server allows it."""

    def __init__(self, io: IoThread, scheduler: Scheduler) -> None:
        self._io = io
        self._scheduler = scheduler
        self._kept: dict[tuple[str, int], _Open] = {}

    def call(self, uri: str, method: str, *arguments: Any, timeout: float = TIMEOUT_S) -> Any:
        """Return the answer to a call; the calling lane is parked meanwhile, while simulated time continues.

        Raises ``XmlRpcFault`` if the peer reports an error, and ``TransportException`` if there is no
        answer: no process listens, the host's name does not resolve, ``timeout`` seconds of real time have passed, or
        the peer is not an XML-RPC server.
        """
        return self._io.ask(
            self._scheduler, self.request(uri, method, arguments, timeout), f"an answer of {uri} to {method}"
        )

    async def request(
        self,
        uri: str,
        method: str,
        arguments: tuple[Any, ...],
        timeout: float = TIMEOUT_S,  # noqa: ASYNC109 - the error tells it
    ) -> Any:
        """Call like :meth:`call`, inside the loop of the I/O thread."""
        host, port = host_and_port(uri)
        body = encode_call(method, arguments)
        try:
            async with asyncio.timeout(timeout):
                answer = await self._exchange(host, port, urlsplit(uri).path or "/", body)
        except TimeoutError as error:
            msg = f"{uri} does not answer {method} within {timeout:g} s: it hangs, or the way there is blocked"
            raise Unreached(msg, host) from error
        except OSError as error:
            raise TransportTerminated(f"the connection to {uri} broke before {method} was answered: {error}") from error
        except h11.ProtocolError as error:
            msg = f"{uri} did not answer {method} as a server of XML-RPC does: {error}"
            raise TransportException(msg) from error
        values, _ = decode(answer)
        return values[0] if values else None

    async def _exchange(self, host: str, port: int, path: str, body: bytes) -> bytes:
        kept = self._kept.pop((host, port), None)
        if kept is not None:
            try:
                answer = await self._post(kept, host, port, path, body)
            except (OSError, h11.RemoteProtocolError):
                answer = None  # the server had closed it in between
            if answer is not None:
                return answer
        made = await connect(host, port)
        try:
            reader, writer = await asyncio.open_connection(sock=made)
        except BaseException:
            made.close()
            raise
        fresh = _Open(h11.Connection(h11.CLIENT, max_incomplete_event_size=HEAD_LIMIT), reader, writer)
        answer = await self._post(fresh, host, port, path, body)
        if answer is None:
            raise TransportTerminated(f"http://{host}:{port}/ closed the connection instead of answering")
        return answer

    async def _post(self, way: _Open, host: str, port: int, path: str, body: bytes) -> bytes | None:
        """Return the answer's body; None if the server closed the connection before answering."""
        fields = [
            ("Host", f"{host}:{port}"),
            ("User-Agent", "rosmini"),
            ("Content-Type", "text/xml"),
            ("Content-Length", str(len(body))),
        ]
        keep = False
        try:
            request = h11.Request(method="POST", target=path, headers=fields)
            write_message(way.state, way.writer, request, body)
            await way.writer.drain()
            answer = bytearray()
            head = await read_message(way.state, way.reader, way.writer, answer.extend)
            if head is None:
                return None
            if isinstance(head, h11.Response) and head.status_code != 200:
                reason = shown(head.reason.decode("latin-1"), MAX_REASON_LENGTH)
                raise TransportException(
                    f"http://{host}:{port}/ answered with HTTP status {head.status_code}: {reason}"
                )
            keep = way.state.our_state is h11.DONE and way.state.their_state is h11.DONE
            return bytes(answer)
        finally:
            if keep:
                way.state.start_next_cycle()
                self._keep((host, port), way)
            else:
                way.writer.transport.abort()  # no one will read data not yet sent

    def _keep(self, address: tuple[str, int], way: _Open) -> None:
        for ended in [each for each, kept in self._kept.items() if kept.reader.at_eof()]:
            self._kept.pop(ended).writer.close()
        if address in self._kept:
            way.writer.close()
            return
        if len(self._kept) >= KEPT:
            self._kept.pop(next(iter(self._kept))).writer.close()
        self._kept[address] = way
        self._io.closers[self.close] = None

    def close(self) -> None:
        """Close the open connections; loop's thread only, which does it at its end."""
        while self._kept:
            self._kept.popitem()[1].writer.close()
