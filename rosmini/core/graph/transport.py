"""The interface between nodes and the transports that carry bytes or objects between them.

A node uses only this interface. Three things cross it: calls of another node's slave API, topic
connections (from a publisher's :class:`Sender` to a subscriber's ``Connection``), and service connections. The
messages that cross it are always *frozen*: private copies, checked and rounded as they would be on a wire.

:mod:`~rosmini.core.graph.local_transport` passes frozen messages directly within a process; `rosmini.ros.net` has the
transport of real ROS. Header fields are those of TCPROS (http://wiki.ros.org/ROS/TCPROS).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from rosmini.core.errors import TransportException, TransportInitError, shown
from rosmini.msgs.message import Message

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .connection import Connection
    from .node import Node
    from .scheduler import Scheduler


Triple = list[Any]
"""The response to each call of the Master and slave APIs: [code, status message, value]."""

Header = dict[str, str]
"""A connection header: the fields that the two ends exchange before the first message."""


LOCAL = "INPROC"
"""Name of the protocol between nodes of one process."""

set_header: Callable[[Any, Header | None], None] = Message.__dict__["_connection_header"].__set__
"""Sets a message's `_connection_header` without the check of names that an assignment makes."""


def extra_fields(headers: Mapping[str, str] | None) -> Header:
    """Return a user's own fields of a connection header.

    Raises ``ValueError`` for names or values that a header cannot contain.
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
    """Number of messages dropped because the subscriber was too slow."""

    @property
    def sent(self) -> int:
        """Number of messages sent, including dropped ones."""

    def send(self, message: Any, size: int | None) -> None:
        """Send a message; ``size`` is the maximum length of the queue (None: no limit).

        A :class:`~rosmini.core.graph.connection.QueuedSender` gets a frozen message that no other code holds; one that
        writes to a wire gets the message's bytes with their length in front, which are made once for all wires.
        """

    def close(self) -> None:
        """Close the connection after all sent messages."""


class ServiceLink(Protocol):
    """The client's end of a service connection."""

    header: Header
    is_remote: bool
    """True if the server is in another process: waiting for it does not stop simulated time."""

    def call(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Send a frozen request; ``reply`` is called in the scheduler's thread, as in :meth:`Session.handle`."""

    def close(self) -> None:
        """Close the connection."""


class Transport(Protocol):
    """Connects nodes to one another."""

    protocol: str

    def attach(self, endpoint: Node, uri: str | None = None) -> str:
        """Make a node reachable.

        Return the URI of its slave API (its ``caller_api``): ``uri`` if it already has one.
        """

    def detach(self, uri: str) -> None:
        """Make a node unreachable; the node itself closes its open connections."""

    def service_uri(self, uri: str) -> str:
        """Return the URI under which the node with slave API ``uri`` serves its services."""

    def reaches(self, uri: str) -> bool:
        """Return True if the node with this slave API, or these services, may be reachable by this transport."""

    def offer(self, caller: str) -> list[Any] | None:
        """Return the protocol entry, [name, ...], that the node at URI ``caller`` sends with ``requestTopic``.

        None if the node does not use this transport.
        """

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return the parameters, [name, ...], with which the node at ``uri`` responds to an offer in ``requestTopic``.

        None if the offer is for another transport.
        """

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Return the response of a node's slave API; may block. Raises ``TransportException`` if there is none."""

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:
        """Call a function in the scheduler's thread after some seconds of wall-clock time, to try a connection again.

        Return False, and do nothing, if a node that has gone never comes back to its address.
        """

    def close(self) -> None:
        """Close all connections, because the graph has been shut down; the transport may be used again."""

    def connect_topic(
        self, caller: str, parameters: list[Any], header: Header, receiver: Connection
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection of the node at ``caller``; may block.

        Return the publisher's header and a function that closes the connection. Raises ``TransportInitError`` if it
        is refused.
        """

    def connect_service(self, caller: str, service_uri: str, header: Header, service_class: Any) -> ServiceLink:
        """Open a service connection of the node at ``caller``, and return it; may block.

        Raises ``TransportInitError`` if it is refused, and ``TransportException`` if the server does not respond.
        """


def slave_uri(uri: str) -> str:
    """Return the address of a node's slave API, given that address or the one of its services."""
    return uri if uri.startswith("http://") else uri.replace("rosrpc://", "http://") + "/"


class Transports:
    """The transports by which nodes reach one another, the preferred one first.

    A node has one address, given by the last transport, which reaches farthest.
    """

    def __init__(self, scheduler: Scheduler, makers: Sequence[Callable[[Scheduler], Transport]]) -> None:
        self._scheduler = scheduler
        self.transports = [make(scheduler) for make in makers]
        self.cut: frozenset[str] = frozenset()
        """Services to which no connection can be made: an injected fault."""
        self._here: dict[str, str] = {}
        """The URIs of this process's nodes, by the URIs of their services."""

    def attach(self, endpoint: Node) -> str:
        """Make a node reachable by every transport; return the URI of its slave API."""
        uri: str | None = None
        for transport in reversed(self.transports):
            uri = transport.attach(endpoint, uri)
        if uri is None:
            raise TransportException("a graph needs a transport")
        self._here[self.service_uri(uri)] = uri
        return uri

    def detach(self, uri: str) -> None:
        """Make a node unreachable."""
        self._here.pop(self.service_uri(uri), None)
        for transport in self.transports:
            transport.detach(uri)

    def add(self, transport: Transport, here: Mapping[str, Node]) -> dict[str, str]:
        """Add a transport, which determines the addresses of nodes from now on.

        ``here`` contains the nodes of this process by their URIs; return their new URIs, and those of their services,
        by the old ones. Connections stay open.
        """
        return self._change([*self.transports, transport], here)

    def remove(self, transport: Transport, here: Mapping[str, Node]) -> dict[str, str]:
        """Remove a transport and close its connections. Returns addresses like :meth:`add`."""
        moved = self._change([each for each in self.transports if each is not transport], here)
        transport.close()
        return moved

    def _change(self, transports: list[Transport], here: Mapping[str, Node]) -> dict[str, str]:
        services = {uri: self.service_uri(uri) for uri in here}
        for uri in here:
            self.detach(uri)
        self.transports = transports
        moved: dict[str, str] = {}
        for uri, endpoint in here.items():
            moved[uri] = self.attach(endpoint)
            moved[services[uri]] = self.service_uri(moved[uri])
        return moved

    def service_uri(self, uri: str) -> str:
        """Return the URI under which the node with slave API ``uri`` serves its services."""
        return self.transports[-1].service_uri(uri)

    def offers(self, caller: str) -> list[list[Any]]:
        """Return the protocol entries that the node at URI ``caller`` sends with ``requestTopic``."""
        return [offer for transport in self.transports if (offer := transport.offer(caller)) is not None]

    def topic_parameters(self, uri: str, offers: list[list[Any]]) -> list[Any] | None:
        """Return the parameters, [name, ...], with which the node at ``uri`` responds to ``requestTopic``.

        They are those of the first transport that accepts one of the offers, or None if none does.
        """
        answers = (transport.topic_parameters(uri, offer) for transport in self.transports for offer in offers)
        return next((answer for answer in answers if answer is not None), None)

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Return the response of a node's slave API; may block. Raises ``TransportException`` if there is none."""
        answer = self._transport_for(uri).call(uri, method, *arguments)
        history = self._scheduler.history
        if history is not None:
            caller, *rest = arguments
            history.called(caller, uri, method, tuple(rest), answer)
        return answer

    def connect_topic(
        self, caller: str, parameters: list[Any], header: Header, receiver: Connection
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection by the transport that ``parameters`` name; see ``Transport.connect_topic``."""
        for transport in self.transports:
            if isinstance(parameters, list) and parameters and parameters[0] == transport.protocol:
                answer, close = transport.connect_topic(caller, parameters, header, receiver)
                history = self._scheduler.history
                if history is not None:
                    publisher = answer.get("callerid", "")
                    history.connected(header["callerid"], publisher, header["topic"], answer.get("type", ""))
                return answer, close
        raise TransportInitError(f"the publisher answered with {shown(parameters)}, which was not offered")

    def connect_service(self, caller: str, service_uri: str, header: Header, service_class: Any) -> ServiceLink:
        """Open a service connection; see ``Transport.connect_service``. Fails for a service in :attr:`cut`."""
        if header.get("service") in self.cut:
            raise TransportException("the connection was cut off on purpose; `%fault clear` ends the fault")
        here = self._here.get(service_uri)
        if here is not None:
            transport = self._transport_for(here)
            return transport.connect_service(caller, transport.service_uri(here), header, service_class)
        return self._transport_for(service_uri).connect_service(caller, service_uri, header, service_class)

    def probe_service(self, uri: str, header: Header, caller: str = "") -> Header:
        """Return the connection header of a service's server. Raises as :meth:`connect_service`."""
        link = self.connect_service(caller, uri, header, None)
        link.close()
        return link.header

    def retry(self, uri: str, seconds: float, function: Callable[[], object]) -> bool:
        """Call a function later, to connect again to the node at ``uri``; return False if it cannot have come back."""
        return self._transport_for(uri).retry(seconds, function)

    def close(self) -> None:
        """Close all connections, because the graph has been shut down."""
        for transport in self.transports:
            transport.close()

    def _transport_for(self, uri: str) -> Transport:
        """Return the first transport that reaches a node, or the last one, whose error best explains why none does."""
        return next((transport for transport in self.transports if transport.reaches(uri)), self.transports[-1])
