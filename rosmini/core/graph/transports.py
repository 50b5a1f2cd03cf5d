"""Several transports in one graph: each connection goes the first way that both of its ends offer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosmini.core.errors import TransportException, TransportInitError, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from .connection import Connection
    from .scheduler import Scheduler
    from .transport import Endpoint, Header, ServiceLink, Transport, Triple


class Transports:
    """The ways in which nodes reach one another, the preferred one first.

    A node has one address, which the last of them gives: the one that reaches farthest.
    """

    def __init__(self, scheduler: Scheduler, makers: Sequence[Callable[[Scheduler], Transport]]) -> None:
        self._scheduler = scheduler
        self.ways = [make(scheduler) for make in makers]
        self.cut: frozenset[str] = frozenset()
        """Services to which no connection can be made: a fault that somebody asked for."""
        self._here: dict[str, str] = {}
        """The nodes of this process: their URIs by those of their services."""

    def attach(self, endpoint: Endpoint) -> str:
        """Make a node reachable in every way; return the URI of its slave API."""
        uri: str | None = None
        for way in reversed(self.ways):
            uri = way.attach(endpoint, uri)
        if uri is None:
            raise TransportException("a graph needs a transport")
        self._here[self.service_uri(uri)] = uri
        return uri

    def detach(self, uri: str) -> None:
        """Make a node unreachable."""
        self._here.pop(self.service_uri(uri), None)
        for way in self.ways:
            way.detach(uri)

    def add(self, way: Transport, here: Mapping[str, Endpoint]) -> dict[str, str]:
        """Take up a further way, which gives the addresses from now on.

        ``here`` has the nodes of this process by their URIs; return their new URIs, and those of their services, by the
        old ones. Connections stay.
        """
        return self._change([*self.ways, way], here)

    def remove(self, way: Transport, here: Mapping[str, Endpoint]) -> dict[str, str]:
        """Do without a way again; what is open in it is closed. Returns addresses as :meth:`add` does."""
        moved = self._change([each for each in self.ways if each is not way], here)
        way.close()
        return moved

    def _change(self, ways: list[Transport], here: Mapping[str, Endpoint]) -> dict[str, str]:
        services = {uri: self.service_uri(uri) for uri in here}
        for uri in here:
            self.detach(uri)
        self.ways = ways
        moved: dict[str, str] = {}
        for uri, endpoint in here.items():
            moved[uri] = self.attach(endpoint)
            moved[services[uri]] = self.service_uri(moved[uri])
        return moved

    def service_uri(self, uri: str) -> str:
        """Return the URI under which the node with slave API ``uri`` serves its services."""
        return self.ways[-1].service_uri(uri)

    def offers(self, caller: str) -> list[list[Any]]:
        """Return what the node at ``caller`` offers in ``requestTopic``."""
        return [offer for way in self.ways if (offer := way.offer(caller)) is not None]

    def topic_parameters(self, uri: str, offers: list[list[Any]]) -> list[Any] | None:
        """Return what ``requestTopic`` of the node at ``uri`` answers: by the first of our ways that is offered."""
        answers = (way.topic_parameters(uri, offer) for way in self.ways for offer in offers)
        return next((answer for answer in answers if answer is not None), None)

    def call(self, uri: str, method: str, *arguments: Any) -> Triple:
        """Call a method of a node's slave API; may block. Raises ``TransportException`` when nobody answers."""
        answer = self._way_to(uri).call(uri, method, *arguments)
        history = self._scheduler.history
        if history is not None:
            caller, *rest = arguments
            history.called(caller, uri, method, tuple(rest), answer)
        return answer

    def connect_topic(
        self, caller: str, parameters: list[Any], header: Header, receiver: Connection
    ) -> tuple[Header, Callable[[], None]]:
        """Open a topic connection in the way that was agreed on; see ``Transport``."""
        for way in self.ways:
            if isinstance(parameters, list) and parameters and parameters[0] == way.protocol:
                answer, close = way.connect_topic(caller, parameters, header, receiver)
                history = self._scheduler.history
                if history is not None:
                    publisher = answer.get("callerid", "")
                    history.connected(header["callerid"], publisher, header["topic"], answer.get("type", ""))
                return answer, close
        raise TransportInitError(f"the publisher answered with {shown(parameters)}, which was not offered")

    def connect_service(
        self, caller: str, service_uri: str, header: Header, service_class: Any
    ) -> ServiceLink:
        """Open a service connection; see :class:`~rosmini.core.graph.transport.Transport`."""
        if header.get("service") in self.cut:
            raise TransportException("the connection was cut off on purpose; `%fault clear` mends it")
        here = self._here.get(service_uri)
        if here is not None:
            way = self._way_to(here)
            return way.connect_service(caller, way.service_uri(here), header, service_class)
        return self._way_to(service_uri).connect_service(caller, service_uri, header, service_class)

    def probe_service(self, uri: str, header: Header, caller: str = "") -> Header:
        """Return the header with which a service's server answers. Raises as :meth:`connect_service`."""
        link = self.connect_service(caller, uri, header, None)
        link.close()
        return link.header

    def retry(self, uri: str, seconds: float, function: Callable[[], object]) -> bool:
        """Call a function later, to connect again to the node at ``uri``; False where it cannot have come back."""
        return self._way_to(uri).retry(seconds, function)

    def close(self) -> None:
        """Give up what is open, for the graph has been shut down."""
        for way in self.ways:
            way.close()

    def _way_to(self, uri: str) -> Transport:
        """Return the first way to a node; the last one tells best why there is none."""
        return next((way for way in self.ways if way.reaches(uri)), self.ways[-1])
