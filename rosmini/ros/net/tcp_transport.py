"""Transport to nodes of other processes and machines, over XML-RPC and TCPROS."""

from __future__ import annotations

import asyncio
from socket import gaierror
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import DeserializationError, TransportException, TransportInitError, shown
from rosmini.core.graph.headers import decode_fields, encode_header
from rosmini.core.graph.slave import METHODS

from .frames import FrameReader
from .io_thread import IoThread, later
from .sockets import Unreached, connect
from .tcp_server import TcpServer
from .tcp_service import TcpServiceLink
from .tcp_stream import Stream
from .tcp_topic import TopicInlet
from .xmlrpc_client import host_and_port
from .xmlrpc_server import XmlRpcServer

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable, Coroutine

    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.node import Node
    from rosmini.core.graph.transport import Header, Triple

    from .network import Network

CONNECT_S = 30.0
"""Timeout of a connection until the peer has sent its header, in wall-clock time [s]."""


class _Place(NamedTuple):
    """Addresses at which a node of this process is reached."""

    host: str
    slave: XmlRpcServer
    topics: TcpServer


class TcpTransport:
    """TCPROS transport; each node has one port for its slave API and one for topics and services, as roscpp needs."""

    protocol = "TCPROS"

    def __init__(self, network: Network) -> None:
        self.network = network
        self._places: dict[str, _Place] = {}

    def attach(self, endpoint: Node, uri: str | None = None) -> str:
        """Make a node reachable.

        Raises ``TransportException`` if the address to listen on is not this machine's.
        """
        network, where = self.network, self.network.where

        def answer(method: str, arguments: tuple[Any, ...]) -> Triple:
            if method not in METHODS:
                raise Exception(f'method "{method}" is not supported')  # noqa: TRY002 - rospy's answer
            return endpoint.slave_call(method, *arguments)

        def complain(host: str, reason: str) -> None:
            network.warn(f"{endpoint.name} refused a request from {host}, at its port for XML-RPC: {reason}")

        try:
            slave = XmlRpcServer(network.io, answer, bind=where.bind, names=where.names, warn=complain)
            topics = TcpServer(network.io, network.scheduler, endpoint, network.warn, bind=where.bind)
        except OSError as error:
            msg = (
                f"{endpoint.name} cannot listen at {where.bind}: {error.strerror or error}. "
                "Set ROS_IP or ROS_HOSTNAME to an address of this machine."
            )
            raise TransportException(msg) from error
        uri = uri or where.uri(slave.port)
        self._places[uri] = _Place(where.host, slave, topics)
        return uri

    def detach(self, uri: str) -> None:
        """Make a node unreachable; the node closes its open connections itself."""
        place = self._places.pop(uri, None)
        if place is not None:
            place.slave.close()
            place.topics.close()

    def service_uri(self, uri: str) -> str:
        """Return the URI under which the node with slave API ``uri`` serves its services."""
        place = self._places.get(uri)
        return "" if place is None else f"rosrpc://{place.host}:{place.topics.port}"

    def reaches(self, uri: str) -> bool:
        """Return True if this is an address of the network."""
        return uri.startswith(("http://", "rosrpc://"))

    def offer(self, caller: str) -> list[Any] | None:
        """Return the protocols that a subscriber offers in ``requestTopic``."""
        return [self.protocol] if caller in self._places else None

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return the connection parameters of a topic."""
        place = self._places.get(uri)
        if place is None or not offer or offer[0] != self.protocol:
            return None
        return [self.protocol, place.host, place.topics.port]

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API, parking the lane. Raises ``TransportException`` without an answer."""
        try:
            answer = self.network.client.call(uri, method, *arguments)
        except Unreached as error:
            raise self._explained(error) from error.__cause__
        if not isinstance(answer, list) or len(answer) != 3:
            raise TransportException(f"{uri} answered {method} with {shown(answer)}, not [code, status, value]")
        return answer

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:
        """Call a function in the scheduler's thread after some seconds of wall-clock time."""
        network = self.network
        if network.io.runs:  # else the graph is ending
            later(network.io.loop, seconds, lambda: network.scheduler.call_soon_threadsafe(function))
        return True

    def connect_topic(
        self,
        caller: str,  # noqa: ARG002 - the seam's
        parameters: list[Any],
        header: Header,
        receiver: Connection,
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection; the lane is parked meanwhile.

        Raises ``TransportInitError`` if the publisher refuses it or has another type, with its header, and
        ``TransportException`` if it cannot be reached.
        """
        try:
            _, host, port = parameters
            host, port = str(host), int(port)
        except (ValueError, TypeError):
            raise TransportInitError(f"the publisher answered with {shown(parameters)}") from None
        network = self.network
        stream, reply, more = self._open(
            open_topic(network.io, host, port, header), f"the publisher of {header['topic']}"
        )
        receiver.info = stream.describe(host)
        name, topic = header["callerid"], header["topic"]

        def complain() -> None:
            who = f"its publisher at {host}:{port}"
            text = f"{name} lost a message on {topic}: {who} closed the connection in the middle of it"
            network.warn(text, (name, topic, host, "cut"))

        inlet = TopicInlet(network.scheduler, stream, receiver, more, complain)
        return reply, inlet.close

    def connect_service(
        self,
        caller: str,  # noqa: ARG002 - the seam's
        service_uri: str,
        header: Header,
        service_class: Any,
    ) -> TcpServiceLink:
        """Open a service connection; the lane is parked meanwhile. Raises the errors of :meth:`connect_topic`."""
        host, port = host_and_port(service_uri, "rosrpc")
        network = self.network
        stream, reply, _ = self._open(
            _open(network.io, host, port, header, ok_byte=True), f"the service {header['service']}"
        )
        return TcpServiceLink(network.scheduler, stream, reply, service_class)

    def _open(self, opening: Coroutine[Any, Any, Opened], what: str) -> Opened:
        """Return an open connection; the lane is parked meanwhile."""
        network = self.network
        try:
            return network.io.ask(network.scheduler, opening, what, _discard)
        except Unreached as error:
            raise self._explained(error) from error.__cause__

    def _explained(self, error: Unreached) -> TransportException:
        """Return an error that also says what to do about the address that a node advertises."""
        if isinstance(error.__cause__, gaierror):
            return error  # it says so already
        return TransportException(f"{error}. {self.network.where.advice(error.host, error.__cause__)}")

    def close(self) -> None:
        """Close the network of this graph; it restarts when needed."""
        for uri in list(self._places):
            self.detach(uri)
        self.network.close()


Opened = tuple[Stream, "Header", list[bytes]]
"""A connection after the exchange of headers, and the frames that have arrived since."""


def _discard(opened: Opened) -> None:
    opened[0].abort()


async def open_topic(io: IoThread, host: str, port: int, header: Header) -> Opened:
    """Connect to a publisher.

    If it refuses the type without saying its own, as ROS's publishers do, it is asked for it, so that the error can
    name it: for a moment it has a subscriber of any type.
    """
    try:
        opened = await _open(io, host, port, header)
    except TransportInitError as error:
        if "md5sum" in error.header or not error.header or header["md5sum"] == "*":
            raise
        try:
            stream, theirs, _ = await _open(io, host, port, {**header, "md5sum": "*", "type": "*"})
        except TransportException:
            raise error from None
        stream.abort()
        raise TransportInitError(str(error), theirs) from None
    stream, theirs, _ = opened
    missing = next((name for name in ("md5sum", "type") if name not in theirs), None)
    if missing is not None:
        stream.abort()
        raise TransportInitError(f"header missing required field [{missing}]")
    if "*" not in (header["md5sum"], theirs["md5sum"]) and header["md5sum"] != theirs["md5sum"]:
        stream.abort()
        raise TransportInitError(f"it sends {theirs['type']} with md5 sum {theirs['md5sum']}", theirs)
    return opened


async def _open(io: IoThread, host: str, port: int, header: Header, *, ok_byte: bool = False) -> Opened:
    """Connect, and exchange headers."""
    try:
        async with asyncio.timeout(CONNECT_S):
            sock = await connect(host, port)
            try:
                return await _shake_hands(io, sock, header, FrameReader(ok_byte=ok_byte))
            except BaseException:
                sock.close()
                raise
    except TimeoutError as error:
        raise Unreached(f"{host}:{port} does not answer within {CONNECT_S:g} s", host) from error
    except DeserializationError as error:
        raise TransportException(f"what answers at {host}:{port} is not a node of ROS 1: {error}") from error
    except OSError as error:
        raise TransportException(f"the connection to {host}:{port} broke: {error}") from error


async def _shake_hands(io: IoThread, sock: socket.socket, header: Header, frames: FrameReader) -> Opened:
    loop = asyncio.get_running_loop()
    await loop.sock_sendall(sock, encode_header(header))
    found: list[bytes] = []
    while not found:
        data = await loop.sock_recv(sock, frames.wanted)
        if not data:
            raise ConnectionResetError("it was closed before its header came")
        found = frames.feed(data)
    reply = decode_fields(found[0])
    if "error" in reply:
        raise TransportInitError(reply["error"], reply)
    return Stream(io, sock, frames), reply, found[1:]
