"""The seam between nodes and the way in which bytes or objects travel between them.

A node knows only what is written here. Three things cross the seam: calls of another node's slave API, topic
connections (from a publisher's :class:`Sender` to a subscriber's ``Connection``), and service connections. What
travels is always a *frozen* message: a private copy, checked and rounded as the wire would round it.

:class:`LocalTransport` hands frozen messages over inside one process. :mod:`rosmini.core.graph.byte_transport`
serialises
them and carries the bytes on real threads. Header fields are those of TCPROS (http://wiki.ros.org/ROS/TCPROS), so that
a TCPROS transport has nothing to add.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import getpid
from socket import gethostname
from typing import TYPE_CHECKING, Any, Protocol

from rosmini.core.errors import TransportTerminated
from rosmini.msgs.message import Message

if TYPE_CHECKING:
    from .connection import Connection
    from .scheduler import Scheduler

Triple = list[Any]
"""What every call of the Master and slave APIs answers: [code, status message, value]."""

Header = dict[str, str]
"""A connection header: the fields that two ends show each other before the first message."""


set_header: Callable[[Any, Header | None], None] = Message.__dict__["_connection_header"].__set__
"""Sets a message's `_connection_header`, past the check of names that an assignment makes."""


def extra_fields(headers: Mapping[str, str] | None) -> Header:
    """Return a user's own fields of a connection header.

    Raises ``ValueError`` for what the header's text cannot hold.
    """
    if headers is not None and not isinstance(headers, Mapping):
        raise ValueError(f"headers are a dictionary of texts, such as {{'cookie': 'abc'}}, not {headers!r}")
    for key, value in (headers or {}).items():
        if not isinstance(key, str) or not isinstance(value, str) or not key or "=" in key:
            raise ValueError(
                f"the header {key!r}: {value!r} does not fit into a connection header: both are texts, and the name "
                "has no '='"
            )
    return dict(headers or {})


class Sender(Protocol):
    """The publisher's end of a topic connection."""

    protocol: str
    destination: str
    info: str
    """The connection's description in ``getBusInfo``; empty if the destination is enough."""
    on_closed: Callable[[], None]
    """Set by the publisher; called in the scheduler's thread when the subscriber has closed the connection."""
    on_dropped: Callable[[], None]
    """Set by the publisher; called in the scheduler's thread when the first message is dropped."""
    dropped: int
    """Number of messages dropped because the subscriber takes them too slowly."""

    @property
    def sent(self) -> int:
        """Number of messages sent."""

    def send(self, message: Any, size: int | None) -> None:
        """Send a message; ``size`` is the maximum length of the queue (None: no limit).

        A :class:`~rosmini.core.graph.connection.QueuedSender` gets a frozen message that nobody else holds; one that
        writes to a wire gets the message's bytes with their length in front, which are made once for all wires.
        """

    def close(self) -> None:
        """Close the connection after what was sent."""


class ServiceSession(Protocol):
    """The server's end of a service connection."""

    header: Header
    service_class: Any

    def handle(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Answer a frozen request by ``reply(frozen_response, None)`` or ``reply(None, error_text)``, now or later."""

    def close(self) -> None:
        """Learn that the client closed the connection."""


class ServiceLink(Protocol):
    """The client's end of a service connection."""

    header: Header
    is_remote: bool
    """True where the server is in another process: waiting for it holds no simulated time."""

    def call(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Send a frozen request; ``reply`` is called in the hub's thread, as in :meth:`ServiceSession.handle`."""

    def close(self) -> None:
        """Close the connection."""


class Endpoint(Protocol):
    """What a node offers to its transport."""

    name: str

    def slave_call(self, method: str, *arguments: Any) -> Triple:
        """Answer a call of the slave API. In any thread, and at once."""

    def accept_subscriber(self, header: Header, sender: Sender) -> Header:
        """Take a subscriber's connection and return the answering header, or raise ``TransportInitError``."""

    def accept_client(self, header: Header) -> ServiceSession:
        """Take a service client's connection, or raise ``TransportInitError``."""


class Transport(Protocol):
    """A way for nodes to reach one another."""

    protocol: str

    def attach(self, endpoint: Endpoint, uri: str | None = None) -> str:
        """Make a node reachable.

        Return the URI of its slave API (its ``caller_api``): ``uri`` if it has one already.
        """

    def detach(self, uri: str) -> None:
        """Make a node unreachable; open connections are the node's to close."""

    def service_uri(self, uri: str) -> str:
        """Return the URI under which the node with slave API ``uri`` serves its services."""

    def reaches(self, uri: str) -> bool:
        """Return whether the node with this slave API, or these services, may be reached in this way."""

    def offer(self, caller: str) -> list[Any] | None:
        """Return what the node at ``caller`` offers in ``requestTopic``, [protocol, ...].

        None if it has no part here.
        """

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return what ``requestTopic`` of the node at ``uri`` answers to an offer, [protocol, ...].

        None: not in this way.
        """

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API; may block. Raises ``TransportException`` when nobody answers."""

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:
        """Call a function in the hub's thread after some seconds on the wall, to try a connection again.

        Return False, and do nothing, where a node that has gone never comes back to its address.
        """

    def close(self) -> None:
        """Give up what is open, for the graph has been shut down; it may be used again."""

    def connect_topic(
        self, caller: str, parameters: list[Any], header: Header, receiver: Connection
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection of the node at ``caller``; may block.

        Return the publisher's header and a function that closes the connection. Raises ``TransportInitError`` when it
        is refused.
        """

    def connect_service(
        self, caller: str, service_uri: str, header: Header, service_class: Any
    ) -> ServiceLink:
        """Open a service connection of the node at ``caller``; may block.

        Raises ``TransportInitError`` when it is refused.
        """


def slave_uri(uri: str) -> str:
    """Return the address of a node's slave API, given that or the one of its services."""
    return uri if uri.startswith("http://") else uri.replace("rosrpc://", "http://") + "/"


class LocalServiceLink:
    """Hands requests to a session in the same process."""

    is_remote = False
    __slots__ = ("_session", "header")

    def __init__(self, session: ServiceSession) -> None:
        self._session = session
        self.header = session.header

    def call(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Hand over a request."""
        self._session.handle(request, reply)

    def close(self) -> None:
        """Close the connection."""
        self._session.close()


class LocalTransport:
    """Nodes of one process, connected by handing frozen messages over."""

    protocol = "INPROC"

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._place = f"{gethostname()}/{getpid()}/{id(self)}"
        self._endpoints: dict[str, Endpoint] = {}
        self._numbers = 0

    def attach(self, endpoint: Endpoint, uri: str | None = None) -> str:
        """Make a node reachable."""
        self._numbers += 1
        uri = uri or f"http://rosmini:{self._numbers}/"
        self._endpoints[uri] = endpoint
        return uri

    def detach(self, uri: str) -> None:
        """Make a node unreachable."""
        self._endpoints.pop(uri, None)

    def service_uri(self, uri: str) -> str:
        """Return the address of the node's services."""
        return uri.replace("http://", "rosrpc://").rstrip("/")

    def reaches(self, uri: str) -> bool:
        """Return whether the node, or the one with these services, is in this process."""
        return slave_uri(uri) in self._endpoints

    def offer(self, caller: str) -> list[Any] | None:
        """Return what a subscriber offers in ``requestTopic``: in which process, and in which graph there, it is."""
        return [self.protocol, self._place] if caller in self._endpoints else None

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return the connection parameters of a topic."""
        is_here = offer in ([self.protocol], [self.protocol, self._place]) and uri in self._endpoints
        return [self.protocol, uri] if is_here else None

    def endpoint(self, uri: str) -> Endpoint:
        """Return the node at ``uri``, of its slave API or its services."""
        found = self._endpoints.get(slave_uri(uri))
        if found is None:
            raise TransportTerminated(f"no node answers at {uri}: it has been shut down")
        return found

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API."""
        return self.endpoint(uri).slave_call(method, *arguments)

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:  # noqa: ARG002 - the seam's
        """Tell that who has gone stays away."""
        return False

    def close(self) -> None:
        """Do nothing: there is nothing open."""

    def connect_topic(
        self,
        caller: str,  # noqa: ARG002 - the seam's
        parameters: list[Any],
        header: Header,
        receiver: Connection,
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection."""
        from .connection import LocalSender

        sender = LocalSender(self._scheduler, receiver, header["callerid"])
        reply = self.endpoint(parameters[1]).accept_subscriber(header, sender)
        return reply, sender.drop

    def connect_service(
        self,
        caller: str,  # noqa: ARG002 - the seam's
        service_uri: str,
        header: Header,
        service_class: Any,  # noqa: ARG002 - the seam's
    ) -> ServiceLink:
        """Open a service connection."""
        return LocalServiceLink(self.endpoint(service_uri).accept_client(header))
