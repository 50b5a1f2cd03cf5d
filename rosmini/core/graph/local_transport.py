"""The transport between nodes of one process, which passes frozen messages directly."""

from __future__ import annotations

from os import getpid
from socket import gethostname
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import TransportTerminated

from .connection import LocalSender
from .transport import LOCAL, ServiceLink, slave_uri

if TYPE_CHECKING:
    from collections.abc import Callable

    from .connection import Connection
    from .node import Node
    from .scheduler import Scheduler
    from .service import Session
    from .transport import Header, Triple


class LocalServiceLink:
    """Passes requests to a session in the same process."""

    is_remote = False
    __slots__ = ("_session", "header")

    def __init__(self, session: Session) -> None:
        self._session = session
        self.header = session.header

    def call(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Pass a request to the session, which calls ``reply`` with the response or an error message."""
        self._session.handle(request, reply)

    def close(self) -> None:
        """Close the connection."""
        self._session.close()


class LocalTransport:
    """Connects the nodes of one process by passing frozen messages directly."""

    protocol = LOCAL

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._place = f"{gethostname()}/{getpid()}/{id(self)}"
        self._endpoints: dict[str, Node] = {}
        self._numbers = 0

    def attach(self, endpoint: Node, uri: str | None = None) -> str:
        """Make a node reachable at ``uri``, by default at a new address; return the address."""
        self._numbers += 1
        uri = uri or f"http://rosmini:{self._numbers}/"
        self._endpoints[uri] = endpoint
        return uri

    def detach(self, uri: str) -> None:
        """Make the node at ``uri`` unreachable."""
        self._endpoints.pop(uri, None)

    def service_uri(self, uri: str) -> str:
        """Return the address of the node's services."""
        return uri.replace("http://", "rosrpc://").rstrip("/")

    def reaches(self, uri: str) -> bool:
        """Return True if the node with this slave API, or with these services, is in this process."""
        return slave_uri(uri) in self._endpoints

    def offer(self, caller: str) -> list[Any] | None:
        """Return the protocol entry that the subscriber at ``caller`` sends in ``requestTopic``.

        It contains the protocol's name and a value that identifies this process and graph. None if ``caller`` is not
        attached to this transport.
        """
        return [self.protocol, self._place] if caller in self._endpoints else None

    def topic_parameters(self, uri: str, offer: list[Any]) -> list[Any] | None:
        """Return [protocol, uri] if the node is attached and the offer comes from this process and graph, else None."""
        is_here = offer in ([self.protocol], [self.protocol, self._place]) and uri in self._endpoints
        return [self.protocol, uri] if is_here else None

    def endpoint(self, uri: str) -> Node:
        """Return the node whose slave API or services have this address. Raises ``TransportTerminated`` if none has."""
        found = self._endpoints.get(slave_uri(uri))
        if found is None:
            raise TransportTerminated(f"no node answers at {uri}: it has been shut down")
        return found

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Return the response of a node's slave API. Raises ``TransportTerminated`` if the node has shut down."""
        return self.endpoint(uri).slave_call(method, *arguments)

    def retry(self, seconds: float, function: Callable[[], object]) -> bool:  # noqa: ARG002 - the interface's
        """Return False: a node that has gone does not come back."""
        return False

    def close(self) -> None:
        """Do nothing: no connection stays open."""

    def connect_topic(
        self,
        caller: str,  # noqa: ARG002 - the interface's
        parameters: list[Any],
        header: Header,
        receiver: Connection,
    ) -> tuple[Header, Callable[[], None]]:
        """Connect ``receiver`` to a publisher; return the publisher's header, and a function that disconnects."""
        sender = LocalSender(self._scheduler, receiver, header["callerid"])
        reply = self.endpoint(parameters[1]).accept_subscriber(header, sender)
        return reply, sender.drop

    def connect_service(
        self,
        caller: str,  # noqa: ARG002 - the interface's
        service_uri: str,
        header: Header,
        service_class: Any,  # noqa: ARG002 - the interface's
    ) -> ServiceLink:
        """Return a connection to the service server at ``service_uri``."""
        return LocalServiceLink(self.endpoint(service_uri).accept_client(header))
