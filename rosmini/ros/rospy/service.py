"""Services: http://wiki.ros.org/rospy/Overview/Services."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

from rosmini.core import time as base
from rosmini.core.errors import ROSException, ROSInterruptException, ServiceException
from rosmini.core.graph.transport import extra_fields
from rosmini.msgs.importer import how_to_import
from rosmini.msgs.message import Message

from .session import answer_interrupt, any_node, current_node, current_session
from .topics import DEFAULT_BUFF_SIZE, resolve_early

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph import Node, ServiceClient, ServiceServer, Waiter

__all__ = ["Service", "ServiceException", "ServiceProxy", "wait_for_service"]


def wait_for_service(service: str, timeout: float | base.Duration | None = None) -> None:
    """Block until ``service`` is offered; also works before ``init_node``.

    Raises ``ROSException`` after ``timeout`` seconds, ``ROSInterruptException`` at shutdown, ``ValueError`` for a
    timeout of zero.
    """
    limit = timeout.to_sec() if isinstance(timeout, base.Duration) else timeout
    if limit == 0:
        raise ValueError("timeout must be non-zero: leave it out to wait for ever")
    node = any_node()
    try:
        node.wait_for_service(service, limit)
    except KeyboardInterrupt as error:
        raise answer_interrupt(node, error) from None


def _check_service_class(service_class: Any) -> None:
    if not inspect.isclass(service_class) or not hasattr(service_class, "_request_class"):
        hint = how_to_import(service_class) or "give one such as std_srvs.srv.SetBool"
        raise ValueError(f"{service_class!r} is not a service class: {hint}")


class _Service:
    """Base class of both sides of a service."""

    def __init__(self, name: str, service_class: Any) -> None:
        self.resolved_name = resolve_early(name, "service")
        _check_service_class(service_class)
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self.uri: str | None = None


class Service(_Service):
    """Offers a service: ``handler(request)`` returns the response, or the values of its fields.

    Args:
        name: the service.
        service_class: its type.
        handler: answers a request; its exceptions reach the caller as a ``ServiceException``.
        buff_size: accepted for compatibility; without effect in one process.
        error_handler: called with (error, its class, the error, traceback) instead of logging when the handler raises.

    Raises ``ValueError`` for an illegal name or an invalid service class, ``ServiceException`` if the node offers
    the service already.

    """

    def __init__(
        self,
        name: str,
        service_class: Any,
        handler: Callable[[Any], Any],
        buff_size: int = DEFAULT_BUFF_SIZE,
        error_handler: Callable[..., object] | None = None,
    ) -> None:
        super().__init__(name, service_class)
        self.handler = handler
        self.buff_size = buff_size
        self._given_name = name
        self._error_handler = error_handler
        self._server: ServiceServer | None = None
        self._ended = False
        self._spinning: list[Waiter] = []
        node = current_node()
        if node is not None:
            self._register(node)
        else:
            current_session().pending.append(self._register)

    def _register(self, node: Node) -> None:
        if self._ended:
            return
        try:
            self._server = node.service(self._given_name, self.service_class, self.handler, numpy=False)
        except ROSException as error:
            raise ServiceException(str(error)) from error
        if self._error_handler is not None:
            self._server.error_handler = self._failed
        self.uri = node.graph.transport.service_uri(node.uri)

    def _failed(self, error: Exception) -> None:
        if self._error_handler is not None:
            self._error_handler(error, type(error), error, error.__traceback__)

    def spin(self) -> None:
        """Block until the service or the node is shut down."""
        server = self._server
        if server is None:
            raise ROSException(
                f"service [{self.resolved_name}] is not offered: call rospy.init_node('name') before spin()"
            )
        if self._ended or server.node.is_shutdown():
            return
        waiter = server.node.waiter(f"the end of the service {self.resolved_name}")
        self._spinning.append(waiter)
        try:
            server.node.wait(waiter)
        except ROSInterruptException:
            return

    def shutdown(self, reason: str = "") -> None:
        """Withdraw the service; may be called repeatedly."""
        self._ended = True
        for waiter in self._spinning:
            waiter.wake()
        if self._server is not None:
            self._server.shutdown(reason)


class ServiceProxy(_Service):
    """Calls a service like a function: ``proxy(request)``, ``proxy(1, 2)`` or ``proxy(a=1, b=2)``.

    Also works before ``init_node``. A ``persistent`` proxy keeps its connection: faster, but it does not find a server
    that replaces the first. ``headers`` are additional fields of the connection header, which the handler finds in
    ``request._connection_header``. Raises ``ValueError`` for an illegal name, an invalid service class and for
    headers that are not texts.
    """

    def __init__(
        self, name: str, service_class: Any, persistent: bool = False, headers: dict[str, str] | None = None
    ) -> None:
        super().__init__(name, service_class)
        self.persistent = persistent
        self.headers = extra_fields(headers)
        self._client: ServiceClient | None = None

    def wait_for_service(self, timeout: float | base.Duration | None = None) -> None:
        """Block until the service is available. Raises the errors of :func:`wait_for_service`."""
        wait_for_service(self.resolved_name, timeout)

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        """Call the service; see :meth:`call`."""
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Send a request and block until the response arrives.

        Raises ``ServiceException`` if there is no server, its handler fails, or it ends meanwhile; ``TypeError``
        for a request of another service; ``genpy.SerializationError`` for a field of the wrong type (rospy converts it
        to its own error for topics only).
        """
        client = self._client
        if client is None or client.node is not any_node():
            client = self._client = any_node().service_client(
                self.resolved_name, self.service_class, persistent=self.persistent, numpy=False, headers=self.headers
            )
        if len(args) == 1 and not kwds:
            self._check_request(args[0])
        return client.call(*args, **kwds)

    def _check_request(self, given: Any) -> None:
        cls = self.request_class
        if isinstance(given, cls) or not isinstance(given, Message):
            return
        if cls._slot_types[:1] != [given._type]:
            raise TypeError(f"request object type [{given._type}] does not match service type [{cls._type}]")

    def close(self) -> None:
        """Close a persistent connection."""
        if self._client is not None:
            self._client.close()
