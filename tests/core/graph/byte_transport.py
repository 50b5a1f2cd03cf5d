"""A transport that serialises everything and carries the bytes on real threads.

Nobody needs it to run a graph: it is the proof that the seam of :mod:`rosmini.core.graph.transport` holds. What crosses
it is what crosses a network (ROS 1 messages, TCPROS headers, XML-RPC documents), each node has a thread of its own that
reads them, and the same tests pass on it as on the in-process transport. While bytes are under way, simulated time
stands still.
"""

from __future__ import annotations

import queue
import threading
import xmlrpc.client
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from rosmini.core.errors import TransportException, TransportInitError, TransportTerminated
from rosmini.core.graph.connection import QueuedSender
from rosmini.core.graph.headers import decode_header, encode_header
from rosmini.core.graph.transport import slave_uri

if TYPE_CHECKING:
    from rosmini.core.graph.connection import Connection
    from rosmini.core.graph.node import Node
    from rosmini.core.graph.scheduler import Scheduler
    from rosmini.core.graph.service import Session
    from rosmini.core.graph.transport import Header, Triple


OnFailure = Callable[[Exception], None]
"""What is called when a connection has failed."""


class _Wire:
    """The thread that reads what is sent to one node, in order."""

    def __init__(self, scheduler: Scheduler, name: str) -> None:
        self._scheduler = scheduler
        self._queue: queue.SimpleQueue[tuple[Callable[[], None], OnFailure] | None] = queue.SimpleQueue()
        self._closed = False
        self._thread = threading.Thread(target=self._read, name=f"rosmini-wire {name}", daemon=True)
        self._thread.start()

    def carry(self, job: Callable[[], None], failed: OnFailure) -> None:
        """Have ``job`` done by the thread; what is sent to a closed wire is lost. In the hub's thread.

        An exception of the job's goes to ``failed``, in the hub's thread.
        """
        if not self._closed:
            self._scheduler.hold()
            self._queue.put((job, failed))

    def close(self) -> None:
        self._closed = True
        self._queue.put(None)
        self._thread.join()

    def _read(self) -> None:
        while (item := self._queue.get()) is not None:
            job, failed = item
            try:
                job()
            except Exception as error:
                self._scheduler.call_soon_threadsafe(partial(failed, error))
            finally:
                self._scheduler.release()


class _ByteSender(QueuedSender):
    """The publisher's end of a connection: what its queue lets go is carried as bytes."""

    protocol = "BYTES"

    __slots__ = ("_scheduler", "_wire")

    def __init__(self, scheduler: Scheduler, wire: _Wire, receiver: Connection, destination: str) -> None:
        super().__init__(scheduler, receiver, destination)
        self._scheduler = scheduler
        self._wire = wire

    def _flush(self) -> None:
        messages = list(self._queue)
        self._queue.clear()
        try:
            packets = [frozen._encode(frozen) for frozen in messages]
        except Exception as error:
            self._failed(error)
        else:
            self._wire.carry(lambda: self._arrive(packets), self._failed)

    def _failed(self, error: Exception) -> None:
        """Close the connection at both ends, once."""
        if not self._closed:
            self.drop()
            self._receiver.failed(error)

    def _arrive(self, packets: list[bytes]) -> None:
        """Decode, in the receiving node's thread, and hand over to the hub."""
        cls = self._receiver.message_class
        messages = [cls._decode(packet) for packet in packets]

        def deliver() -> None:
            if not self._closed:
                self._receiver.deliver(messages)

        self._scheduler.call_soon_threadsafe(deliver)

    def _close(self) -> None:
        tell = super()._close
        self._wire.carry(lambda: self._scheduler.call_soon_threadsafe(tell), self._failed)


class _ByteServiceLink:
    """The client's end of a service connection."""

    is_remote = False

    def __init__(self, transport: ByteTransport, wire: _Wire, session: Session, service_class: Any) -> None:
        self._scheduler = transport.scheduler
        self._wire = wire
        self._session = session
        self._class = service_class
        self.header = session.header

    def call(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        def failed(error: Exception) -> None:
            reply(None, f"transport error completing service call: {type(error).__name__}: {error}")

        packet = request._encode(request)
        request_class, response_class = self._class._request_class, self._class._response_class

        def answer(response: Any, problem: str | None) -> None:
            body = b"\x00" + problem.encode() if problem is not None else b"\x01" + bytes(response._encode(response))
            self._wire.carry(lambda: arrive(body), failed)

        def arrive(body: bytes) -> None:
            if body[0]:
                response = response_class._decode(body[1:])
                self._scheduler.call_soon_threadsafe(lambda: reply(response, None))
            else:
                self._scheduler.call_soon_threadsafe(lambda: reply(None, body[1:].decode()))

        def ask() -> None:
            received = request_class._decode(packet)
            self._scheduler.call_soon_threadsafe(lambda: self._session.handle(received, answer))

        self._wire.carry(ask, failed)

    def close(self) -> None:
        self._scheduler.call_soon(self._session.close)


class ByteTransport:
    """Nodes of one process that exchange bytes through threads."""

    protocol = "BYTES"

    def __init__(self, scheduler: Scheduler) -> None:
        self.scheduler = scheduler
        self._endpoints: dict[str, tuple[Node, _Wire]] = {}
        self._numbers = 0

    def attach(self, endpoint: Node, uri: str | None = None) -> str:
        """Make a node reachable, with a thread of its own."""
        self._numbers += 1
        uri = uri or f"http://bytes:{self._numbers}/"
        self._endpoints[uri] = (endpoint, _Wire(self.scheduler, endpoint.name))
        return uri

    def detach(self, uri: str) -> None:
        """Make a node unreachable and end its thread when it has read what is under way."""
        found = self._endpoints.pop(uri, None)
        if found is not None:
            found[1].close()

    def service_uri(self, uri: str) -> str:
        """Return the address of the node's services."""
        return uri.replace("http://", "rosrpc://").rstrip("/")

    def reaches(self, uri: str) -> bool:
        """Return whether a node has this slave API or serves its services there."""
        return slave_uri(uri) in self._endpoints

    def offer(self, caller: str) -> list[Any] | None:
        """Return what a subscriber offers in ``requestTopic``."""
        return [self.protocol] if caller in self._endpoints else None

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return the connection parameters of a topic."""
        return [self.protocol, uri] if offer == [self.protocol] and uri in self._endpoints else None

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API through an XML-RPC document; blocks. The node's thread answers."""
        request = xmlrpc.client.dumps(arguments, method, allow_none=False)

        def serve(endpoint: Node) -> str:
            values, name = xmlrpc.client.loads(request)
            return xmlrpc.client.dumps((endpoint.slave_call(cast("str", name), *values),), methodresponse=True)

        reply = self._ask(uri, serve, in_scheduler=False)
        return cast("Triple", xmlrpc.client.loads(reply)[0][0])

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:
        """Tell that who has gone stays away."""
        return False

    def close(self) -> None:
        """Do nothing: each node's thread ends with the node."""

    def connect_topic(
        self, caller: str, parameters: list[Any], header: Header, receiver: Connection
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection by exchanging headers; blocks."""
        request = encode_header(header)
        made: list[_ByteSender] = []

        def serve(endpoint: Node) -> bytes:
            fields = decode_header(request)
            sender = _ByteSender(self.scheduler, self._wire_of(caller), receiver, fields["callerid"])
            made.append(sender)
            return encode_header(endpoint.accept_subscriber(fields, sender))

        reply = decode_header(self._ask(parameters[1], serve))
        return reply, made[0].drop

    def connect_service(self, caller: str, service_uri: str, header: Header, service_class: Any) -> _ByteServiceLink:
        """Open a service connection by exchanging headers; blocks."""
        request = encode_header(header)

        def serve(endpoint: Node) -> Session:
            return endpoint.accept_client(decode_header(request))

        session = self._ask(slave_uri(service_uri), serve)
        return _ByteServiceLink(self, self._wire_of(caller), session, service_class)

    def _wire_of(self, caller: str) -> _Wire:
        found = self._endpoints.get(caller)
        if found is None:
            msg = f"the node at {caller} has no connection to the graph any more"
            raise TransportInitError(msg)
        return found[1]

    def _ask(self, uri: str, serve: Callable[[Node], Any], *, in_scheduler: bool = True) -> Any:
        """Have ``serve`` run in the node's thread, or in the hub's on its behalf; park the caller meanwhile."""
        found = self._endpoints.get(uri)
        if found is None:
            msg = f"no node answers at {uri}: it has been shut down"
            raise TransportTerminated(msg)
        endpoint, wire = found
        waiter = self.scheduler.waiter(f"an answer of {endpoint.name}")

        def work() -> None:
            try:
                waiter.wake(serve(endpoint))
            except Exception as error:
                waiter.fail(error)

        def failed(error: Exception) -> None:
            problem = TransportException(f"the connection to {endpoint.name} failed: {type(error).__name__}: {error}")
            problem.__cause__ = error
            waiter.fail(problem)

        job = partial(self.scheduler.call_soon_threadsafe, work) if in_scheduler else work
        wire.carry(job, failed)
        waiter.wait()
        return waiter.value
