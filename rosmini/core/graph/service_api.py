"""Services as a node offers and calls them (http://wiki.ros.org/Services)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from rosmini.core.errors import ROSException, TransportException, TransportInitError

from .parameter_api import ParameterApi
from .service import ServiceClient, ServiceServer, Session

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node import Node
    from .transport import Header


class ServiceApi(ParameterApi):
    """The part of a :class:`~rosmini.core.graph.node.Node` that has to do with services."""

    uri: str
    services: dict[str, ServiceServer]
    """What the node offers, by name."""

    def service(
        self, name: str, service_class: Any, handler: Callable[[Any], Any], *, numpy: bool = True
    ) -> ServiceServer:
        """Offer a service: ``handler(request)`` returns the response.

        Raises ``ROSException`` if this node offers it already.
        """

        def make() -> ServiceServer:
            resolved = self.resolve(name)
            self._require_running(f"offer {resolved}")
            if resolved in self.services:
                msg = (
                    f"service [{resolved}] is already offered by {self.name}: "
                    "shut the first one down before offering it again"
                )
                raise ROSException(msg)
            server = self.services[resolved] = ServiceServer(
                cast("Node", self), resolved, service_class, handler, numpy=numpy
            )
            uri = self.graph.transport.service_uri(self.uri)
            try:
                self.master.register("registerService", resolved, uri, self.uri, warn=self.logerr)
            except ROSException:
                del self.services[resolved]
                raise
            return server

        return self.scheduler.on_hub(make)

    def service_client(
        self,
        name: str,
        service_class: Any,
        *,
        persistent: bool = False,
        numpy: bool = True,
        headers: Header | None = None,
    ) -> ServiceClient:
        """Return what calls a service, whether it is there yet or not.

        ``headers`` are further fields of the connection header.
        """
        return ServiceClient(
            cast("Node", self),
            self.resolve(name),
            service_class,
            persistent=persistent,
            numpy=numpy,
            headers=headers,
        )

    def drop_service(self, server: ServiceServer) -> None:
        """Withdraw a service. For the server only."""
        if self.services.get(server.name) is server:
            del self.services[server.name]
        uri = self.graph.transport.service_uri(self.uri)
        self.master.unregister("unregisterService", server.name, uri, warn=self.logwarn)

    def wait_for_service(self, name: str, timeout: float | None = None) -> None:
        """Block until somebody offers the service, and answers there: a node that was killed is still listed.

        Raises ``ROSException`` after ``timeout`` seconds.
        """
        resolved = self.resolve(name)
        silent: list[str] = []

        def is_there() -> bool:
            uri = self.master.find("lookupService", resolved)
            silent[:] = [] if uri is None or self._answers(resolved, uri) else [uri]
            return uri is not None and not silent

        self.wait_for_master(
            is_there,
            timeout,
            f"the service {resolved} to be offered",
            lambda: f"nobody answers at {silent[0]}" if silent else f"nobody offers {resolved}",
            look_again=lambda: bool(silent),
        )

    def _answers(self, service: str, uri: str) -> bool:
        header = {"callerid": self.name, "md5sum": "*", "probe": "1", "service": service}
        try:
            self.graph.transport.probe_service(uri, header, self.uri)
        except TransportException:
            return False
        return True

    def accept_client(self, header: Header) -> Session:
        """Take a service client's connection."""
        server = None if self._stopped else self.services.get(header.get("service", ""))
        if server is None:
            raise TransportInitError(f"[{self.name}] is not a provider of [{header.get('service')}]")
        return server.accept(header)
