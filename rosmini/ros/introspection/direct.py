"""Direct blocking calls to a Master and nodes in other processes, for tools that do nothing else.

A tool such as ``rostopic list`` makes two calls and exits. Starting a graph with its scheduler and I/O thread would
take longer than the calls, so this module calls directly: :mod:`xmlrpc.client` over plain HTTP, with
timeouts, limited answers, and no document types in the XML.
"""

from __future__ import annotations

import http.client
import os
import socket
import struct
import time
import xmlrpc.client
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit
from xml.parsers.expat import ExpatError

from rosmini.core.errors import MasterUnreachable, ROSException, RosminiError, TransportException, shown

if TYPE_CHECKING:
    from typing import Self

    from rosmini.core.peers import Triple

MASTER_S = 10.0
"""Timeout for an answer of the Master [s]."""

NODE_S = 3.0
"""Timeout for an answer of a node [s], the same as in ``rosnode ping``."""

MAX_BYTES = 64 * 1024 * 1024
"""Maximum size of an answer [bytes]."""

_PIECE = 65536


class RefusedXml(xmlrpc.client.ResponseError):
    """The answer contains XML that no ROS program sends."""


class _Parser(xmlrpc.client.ExpatParser):
    """The standard library's parser, but it refuses entity declarations, since entities can grow without limit."""

    def __init__(self, target: Any) -> None:
        super().__init__(target)
        expat: Any = vars(self)["_parser"]
        expat.StartDoctypeDeclHandler = expat.EntityDeclHandler = self._refuse

    @staticmethod
    def _refuse(*_declaration: object) -> None:
        raise RefusedXml("the answer declares a document type or an entity, which XML-RPC does not have")


class _Transport(xmlrpc.client.Transport):
    """The standard library's transport, with a timeout and a size limit."""

    user_agent = "rosmini"
    accept_gzip_encoding = False

    def __init__(self, timeout: float) -> None:
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        """Return the open connection to a host, or a new one."""
        if self._connection[0] != host:
            self.close()
            self._connection = host, http.client.HTTPConnection(host, timeout=self._timeout)
        connection: http.client.HTTPConnection = self._connection[1]  # type: ignore[assignment]
        return connection

    def getparser(self) -> tuple[Any, Any]:
        """Return a parser and its target, which collects the results."""
        target = xmlrpc.client.Unmarshaller(use_builtin_types=True)
        return _Parser(target), target

    def parse_response(self, response: Any) -> Any:
        """Return the values in an answer. Raises ``ResponseError`` if it is too long."""
        parser, target = self.getparser()
        size = 0
        while data := response.read(_PIECE):
            size += len(data)
            if size > MAX_BYTES:
                raise RefusedXml(f"the answer has more than {MAX_BYTES:,} bytes")
            parser.feed(data)
        parser.close()
        return target.close()


_FAILURES = (OSError, http.client.HTTPException, xmlrpc.client.Error, ExpatError, ValueError)


class DirectWire:
    """The Master at an address, and its nodes; see :class:`~rosmini.core.peers.Peers`."""

    def __init__(self, master_uri: str, *, master_s: float = MASTER_S, node_s: float = NODE_S) -> None:
        self.master_uri = master_uri
        self._master_s, self._node_s = master_s, node_s
        self._servers: dict[str, xmlrpc.client.ServerProxy] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        """Close the connections."""
        for server in self._servers.values():
            server("close")()
        self._servers.clear()

    @property
    def transport(self) -> DirectWire:
        """The transport to the nodes."""
        return self

    @property
    def scheduler(self) -> WallClock:
        """The wall clock."""
        return WallClock()

    def ask_as(self, caller_id: str) -> DirectMaster:
        """Return the Master as called by this name."""
        return DirectMaster(self, caller_id)

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a Master or node. Raises ``TransportException`` with the cause if there is no answer."""
        try:
            server = self._servers.get(uri)
            if server is None:
                patience = self._master_s if uri == self.master_uri else self._node_s
                server = self._servers[uri] = xmlrpc.client.ServerProxy(uri, _Transport(patience))
            answer: Any = getattr(server, method)(*arguments)
        except _FAILURES as error:
            raise TransportException(f"no answer from {uri}: {_reason(error)}") from error
        if not isinstance(answer, list) or len(answer) != 3:
            raise TransportException(f"{uri} answered {method} with {str(answer)[:80]}, which no ROS program does")
        return answer

    def probe_service(self, uri: str, header: dict[str, str]) -> dict[str, str]:
        """Return the header with which a service's server replies. Raises ``TransportException``."""
        from rosmini.core.graph.headers import HEADER_LIMIT, decode_fields, encode_header

        try:
            parts = urlsplit(uri)
            with socket.create_connection((parts.hostname or "", parts.port or 0), timeout=self._node_s) as wire:
                wire.sendall(encode_header(header))
                with wire.makefile("rb") as incoming:
                    (length,) = struct.unpack("<I", incoming.read(4))
                    if length > HEADER_LIMIT:
                        raise TransportException(f"{uri} announced a connection header of {length} bytes")
                    return decode_fields(incoming.read(length))
        except (OSError, ValueError, struct.error, RosminiError) as error:
            raise TransportException(f"no answer from the service at {uri}: {_reason(error)}") from error


class DirectMaster:
    """The Master, called in the name of ``caller_id``; see :class:`~rosmini.core.peers.Asker`."""

    def __init__(self, wire: DirectWire, caller_id: str) -> None:
        self._wire = wire
        self._caller_id = caller_id

    def call(self, method: str, *arguments: Any) -> Triple:
        """Return the Master's answer. Raises ``MasterUnreachable``."""
        try:
            return self._wire.call(self._wire.master_uri, method, self._caller_id, *arguments)
        except TransportException as error:
            cause = error.__cause__ or error
            raise MasterUnreachable(_complaint(self._wire.master_uri, cause)) from error.__cause__

    def ask(self, method: str, *arguments: Any) -> Any:
        """Return the value of the answer. Raises ``ROSException`` for any code but 1, and ``MasterUnreachable``."""
        code, status, value = self.call(method, *arguments)
        if code != 1:
            raise ROSException(f"the Master refused {method} of {self._caller_id}: {status}")
        return value

    def find(self, method: str, *arguments: Any) -> Any:
        """Return the value of the answer, or None if the code is not 1. Raises ``MasterUnreachable``."""
        code, _, value = self.call(method, *arguments)
        return value if code == 1 else None


class WallClock:
    """The wall clock; see :class:`~rosmini.core.peers.Clock`."""

    def now_ns(self) -> int:
        """Return the time in nanoseconds; only differences are meaningful."""
        return time.perf_counter_ns()

    def sleep_until(self, when_ns: int, reason: str | None = None) -> None:  # noqa: ARG002 - the protocol's
        """Block until that time."""
        time.sleep(max(when_ns - time.perf_counter_ns(), 0) / 1e9)


def _complaint(uri: str, cause: BaseException) -> str:
    """Return why a Master does not answer, and what to do about it."""
    silent = f"the Master at {uri} does not answer: "
    another = "set ROS_MASTER_URI to the address of one that runs"
    if isinstance(cause, socket.gaierror):
        host = shown(urlsplit(uri).hostname or "")
        return f"{silent}the host name {host} does not resolve on this machine: add it to /etc/hosts here, or {another}"
    if isinstance(cause, TimeoutError):
        return f"{silent}{_reason(cause)}. It hangs, or the way there is blocked: start it again, or {another}"
    if isinstance(cause, OSError):
        return f"{silent}{_reason(cause)}. Start it with `rosmini roscore`, or {another}"
    if isinstance(cause, xmlrpc.client.ProtocolError):
        why = f"it answered with HTTP status {cause.errcode}: {shown(cause.errmsg, 500)}"
    else:
        why = _reason(cause)
    return f"what answers at {uri} is not a ROS Master: {why}. Set ROS_MASTER_URI to the address that roscore shows"


def _reason(error: BaseException) -> str:
    if isinstance(error, OSError) and error.errno is not None and error.strerror:
        return os.strerror(error.errno) if error.errno > 0 else str(error.strerror)
    return str(error) or type(error).__name__
