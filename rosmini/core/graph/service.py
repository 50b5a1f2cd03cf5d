"""Services: a request and one response (http://wiki.ros.org/Services)."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import (
    DeserializationError,
    MasterUnreachable,
    ROSException,
    ROSInterruptException,
    SerializationError,
    ServiceException,
    ServiceRefused,
    TransportException,
    TransportInitError,
    nearest,
)

from .mismatch import recast
from .transport import extra_fields, set_header

if TYPE_CHECKING:
    from collections.abc import Callable

    from .node import Node
    from .transport import Header, ServiceLink


_OTHER = "service of another type"
NO_TEXT = "b''"
"""The text that rospy shows for an error whose text is empty, such as a refusal by a C++ node."""


class Services(dict[str, "ServiceServer"]):
    """The services that a node offers, by name."""

    def __init__(self, node: Node) -> None:
        super().__init__()
        self._node = node

    def offer(
        self, name: str, service_class: Any, handler: Callable[[Any], Any], *, numpy: bool = True
    ) -> ServiceServer:
        """Offer a service, and return its server; ``handler(request)`` returns the response.

        Raises ``ROSException`` if this node offers it already.
        """

        def make() -> ServiceServer:
            resolved = self._node.resolve(name)
            self._node.require_running(f"offer {resolved}")
            if resolved in self:
                msg = (
                    f"service [{resolved}] is already offered by {self._node.name}: "
                    "shut the first one down before offering it again"
                )
                raise ROSException(msg)
            server = self[resolved] = ServiceServer(self._node, resolved, service_class, handler, numpy=numpy)
            uri = self._node.graph.transport.service_uri(self._node.uri)
            try:
                self._node.master.register("registerService", resolved, uri, self._node.uri, warn=self._node.logerr)
            except ROSException:
                del self[resolved]
                raise
            return server

        return self._node.scheduler.run_in_scheduler(make)

    def drop(self, server: ServiceServer) -> None:
        """Unregister a service. Called only by its server."""
        if self.get(server.name) is server:
            del self[server.name]
        uri = self._node.graph.transport.service_uri(self._node.uri)
        self._node.master.unregister("unregisterService", server.name, uri, warn=self._node.logwarn)

    def wait_for(self, name: str, timeout: float | None = None) -> None:
        """Block until a node that responds offers the service; a killed node is still listed but does not respond.

        Raises ``ROSException`` after ``timeout`` seconds.
        """
        resolved = self._node.resolve(name)
        silent: list[str] = []

        def is_there() -> bool:
            uri = self._node.master.find("lookupService", resolved)
            silent[:] = [] if uri is None or self._answers(resolved, uri) else [uri]
            return uri is not None and not silent

        self._node.wait_for_master(
            is_there,
            timeout,
            f"the service {resolved} to be offered",
            lambda: f"nobody answers at {silent[0]}" if silent else f"nobody offers {resolved}",
            must_poll=lambda: bool(silent),
        )

    def _answers(self, service: str, uri: str) -> bool:
        header = {"callerid": self._node.name, "md5sum": "*", "probe": "1", "service": service}
        try:
            self._node.graph.transport.probe_service(uri, header, self._node.uri)
        except TransportException:
            return False
        return True

    def accept(self, header: Header) -> Session:
        """Accept a service client's connection; return its session.

        Raises ``TransportInitError`` if the node does not offer the service, or the client's type does not match.
        """
        server = None if self._node.is_shutdown() else self.get(header.get("service", ""))
        if server is None:
            raise TransportInitError(f"[{self._node.name}] is not a provider of [{header.get('service')}]")
        return server.accept(header)


class ServiceServer:
    """Handles the calls of one service. Made by :meth:`Node.service <rosmini.core.graph.node.Node.service>`.

    The handler receives the request and returns a response or its fields: a tuple or list of its fields in order, a
    dictionary of fields by name, or the value of its only field. None is refused, even for a response without fields,
    as in rospy. Each client connection has a separate lane, so a handler may block.
    """

    def __init__(
        self, node: Node, name: str, service_class: Any, handler: Callable[[Any], Any], *, numpy: bool = True
    ) -> None:
        self.node = node
        self.name = name
        self.service_class = service_class
        self.handler = handler
        self.sessions: list[Session] = []
        self._receive = receiver(service_class._request_class, numpy=numpy)
        self.error_handler: Callable[[Exception], object] | None = None
        """Called instead of the report if the handler raises an exception."""
        self._open = True

    def __repr__(self) -> str:
        return f"<ServiceServer {self.name} [{self.service_class._type}] of {self.node.name}>"

    def accept(self, header: Header) -> Session:
        """Accept a client's connection; return its session.

        Raises ``TransportInitError`` if the client's md5 sum is neither that of the service's type nor ``*``.
        """
        md5sum, own = header.get("md5sum"), self.service_class._md5sum
        if md5sum not in ("*", own):
            msg = f"request from [{header.get('callerid', 'unknown')}]: md5sums do not match: [{md5sum}] vs. [{own}]"
            raise TransportInitError(msg)
        session = Session(self, header)
        self.sessions.append(session)
        return session

    def respond(self, request: Any, header: Header) -> Any:
        """Return the frozen response to a frozen request; ``header`` is the client's connection header.

        Raises ``ServiceException``, with the text for the client, if the handler fails or refuses the request, or if
        the request or the response is invalid.
        """
        response_class = self.service_class._response_class
        try:
            received = self._receive(request, header)
        except DeserializationError as error:
            msg = f"error processing request: {error}"
            raise ServiceException(msg) from error
        try:
            answer = self.handler(received)
        except ServiceException as error:  # a handler raises it to refuse a request
            silent = isinstance(error, ServiceRefused)
            msg = str(error) if silent else f"service cannot process request: {error}"
            raise ServiceException(msg) from error
        except Exception as error:
            if self.error_handler is not None:
                self.node.guarded(self.error_handler, error, what=f"error handler of {self.name}")
            else:
                self.node.callback_failed(error, self.handler, self.name, request, service=True)
            msg = f"error processing request: {error}"
            raise ServiceException(msg) from error
        try:
            return response_class._freeze(_response_from(answer, response_class))
        except (ServiceException, SerializationError, TypeError, AttributeError) as error:
            msg = f"service cannot process request: {error}"
            self.node.logerr(f"{self.name}: {msg}{self._hint(answer)}")
            raise ServiceException(msg) from error

    def _hint(self, answer: Any) -> str:
        if answer is not None or self.service_class._response_class.__slots__:
            return ""
        return ". For a response without fields return [] or the response itself, as rospy wants it"

    def shutdown(self, reason: str = "") -> None:
        """Stop offering the service; waiting callers get an error. Safe to call again."""
        if self._open:
            self._open = False
            self.close_sessions(reason)
            self.node.services.drop(self)

    def close_sessions(self, reason: str) -> None:
        """Close all client connections; queued requests, and those being handled, get an error with ``reason``."""
        for session in list(self.sessions):
            session.abort(reason)


def receiver(message_class: Any, *, numpy: bool) -> Callable[[Any, Header], Any]:
    """Return a function that converts a frozen request or response to the receiver's object, and sets its header.

    With ``numpy``, numeric arrays become numpy arrays, otherwise tuples.
    """
    thaw = message_class._thawer(numpy=numpy)

    def receive(frozen: Any, header: Header) -> Any:
        message = frozen if type(frozen) is message_class else recast(frozen, message_class)
        if thaw is not None:
            message = thaw(message)
        set_header(message, header)
        return message

    return receive


def _response_from(answer: Any, response_class: Any) -> Any:
    """Return the response for a handler's return value, by rospy's rules. Raises ``ServiceException`` if invalid."""
    slots = response_class.__slots__
    if isinstance(answer, response_class):
        return answer
    if answer is None:
        msg = "service handler returned None"
        raise ServiceException(msg)
    if isinstance(answer, dict):
        return response_class(**answer)
    if isinstance(answer, (list, tuple)):
        if len(answer) != len(slots):
            msg = (
                f"handler returned invalid value: {response_class._type} has {len(slots)} fields "
                f"({', '.join(slots)}), not {len(answer)}"
            )
            raise ServiceException(msg)
        return response_class(*answer)
    if len(slots) != 1:
        fields = ", ".join(slots) or "it has no fields"
        msg = f"handler returned invalid value: {answer!r} is no {response_class._type} ({fields})"
        raise ServiceException(msg)
    return response_class(answer)


class Session:
    """The server's end of one client connection."""

    def __init__(self, server: ServiceServer, client_header: Header) -> None:
        node = server.node
        self.server = server
        self.service_class = server.service_class
        self._client_header = client_header
        self.header: Header = {
            "callerid": node.name,
            "md5sum": server.service_class._md5sum,
            "service": server.name,
            "type": server.service_class._type,
        }
        self._lane = node.spawn(f"{node.name} service {server.name}")
        self._pending: list[Callable[[Any, str | None], None]] = []
        self._gone: str | None = None

    def handle(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        """Handle a frozen request in the session's lane, then call ``reply(response, problem)``.

        If the request succeeds, ``problem`` is None; otherwise it is an error text, and the response is None.
        """
        if self._gone is not None:
            reply(None, self._gone)
            return
        self._pending.append(reply)
        self._lane.post(partial(self._answer, request, reply))

    def _answer(self, request: Any, reply: Callable[[Any, str | None], None]) -> None:
        history = self.server.node.scheduler.history
        if history is not None:
            history.serve(request)
        try:
            response, problem = self.server.respond(request, self._client_header), None
        except ServiceException as error:
            response, problem = None, str(error)
        except ROSInterruptException as error:
            response, problem = None, f"error processing request: {error}"
        if reply in self._pending:
            self._pending.remove(reply)
            reply(response, problem)
        if history is not None:
            history.act_on(None)

    def close(self) -> None:
        """Remove the session after the client has closed the connection."""
        if self in self.server.sessions:
            self.server.sessions.remove(self)

    def abort(self, reason: str) -> None:
        """Reply to all pending requests with an error, because the server is closing, and remove the session."""
        pending, self._pending = self._pending, []
        why = f" ({reason})" if reason else ""
        self._gone = f"transport error completing service call: the server was shut down{why}"
        for reply in pending:
            reply(None, self._gone)
        self.close()


class ServiceClient:
    """Calls a service. Made by :meth:`Node.service_client <rosmini.core.graph.node.Node.service_client>`.

    ``client(a=1, b=2)``, ``client(1, 2)`` and ``client.call(request)`` are equivalent. A persistent client keeps its
    connection: it is faster, but does not notice when the server is replaced.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        service_class: Any,
        *,
        persistent: bool = False,
        numpy: bool = True,
        headers: Header | None = None,
    ) -> None:
        self.node = node
        self.name = name
        self.service_class = service_class
        self.persistent = persistent
        self.headers = extra_fields(headers)
        self._receive = receiver(service_class._response_class, numpy=numpy)
        self._link: ServiceLink | None = None
        self._closed = False

    def __repr__(self) -> str:
        return f"<ServiceClient {self.name} [{self.service_class._type}] of {self.node.name}>"

    def call(self, *args: Any, **fields: Any) -> Any:
        """Send a request and block until the response arrives.

        Raises ``ServiceException`` if there is no server, if it offers another type, if its handler fails, or
        if it goes away meanwhile; ``SerializationError`` for a field of the wrong type; and
        ``ROSInterruptException`` if this node is shut down meanwhile.
        """
        request_class = self.service_class._request_class
        if len(args) == 1 and not fields and isinstance(args[0], request_class):
            request = args[0]
        else:
            request = request_class(*args, **fields)
        return self.node.scheduler.run_in_scheduler(self._call, request)

    def _call(self, given: Any) -> Any:
        link = self._link or self._connect()
        history, request = self.node.scheduler.history, None
        waiter = self.node.waiter(f"the service {self.name}", remote=link.is_remote)
        try:
            frozen = type(given)._freeze(given)
            if history is not None:
                request = history.requested(self.node.name, link.header.get("callerid", ""), self.name, frozen)
            link.call(frozen, lambda response, problem: waiter.wake((response, problem)))
            self.node.wait(waiter)
        finally:
            if not self.persistent:
                link.close()
        response, problem = waiter.value
        if request is not None:
            history.answered(request, response, problem)
        if problem is not None:
            if self.persistent and problem.startswith("transport error"):
                self.close()
            msg = (
                problem
                if problem.startswith("transport error")
                else f"service [{self.name}] responded with an error: {problem or NO_TEXT}"
            )
            raise ServiceException(msg)
        return self._receive(response, link.header)

    __call__ = call

    def _connect(self) -> ServiceLink:
        if self._closed:
            msg = f"service [{self.name}]: this persistent client was closed; make a new one"
            raise ServiceException(msg)
        node = self.node
        if node.is_shutdown():
            msg = f"service [{self.name}] called after node {node.name} was shut down"
            raise ServiceException(msg)
        uri = self._lookup()
        cls = self.service_class
        fields = {"callerid": node.name, "md5sum": cls._md5sum, "service": self.name, **self.headers}
        if self.persistent:
            fields["persistent"] = "1"
        header = dict(sorted(fields.items()))
        try:
            link = node.graph.transport.connect_service(node.uri, uri, header, cls)
        except TransportInitError as error:
            theirs = self._type_at(uri)
            if theirs in (cls._type, _OTHER):  # refused for another reason, such as a user-supplied header
                msg = f"unable to connect to service [{self.name}]: {error}"
                raise ServiceException(msg) from error
            msg = (
                f"service [{self.name}] is a {theirs}, and was called as a {cls._type}: {error}. Use the server's type."
            )
            raise ServiceException(msg) from error
        except TransportException as error:
            msg = f"unable to connect to service [{self.name}]: {error}"
            raise ServiceException(msg) from error
        if self.persistent:
            self._link = link
        return link

    def _lookup(self) -> str:
        """Return the service's address.

        Raises ``ServiceException`` if no node offers it, or if the Master does not respond.
        """
        master = self.node.master
        try:
            uri: str | None = master.find("lookupService", self.name)
            if uri is not None:
                return uri
            known = [name for name, _ in master.ask("getSystemState")[2]]
        except MasterUnreachable as error:
            msg = f"service [{self.name}] unavailable: {error}"
            raise ServiceException(msg) from error
        hint = nearest(self.name, known) or "Start its server, or call wait_for_service() first."
        msg = f"service [{self.name}] unavailable: no node offers it. {hint}"
        raise ServiceException(msg)

    def _type_at(self, uri: str) -> str:
        """Return the service's type, which its server reports to a probe, as to ``rosservice type``."""
        node = self.node
        header = {"callerid": node.name, "md5sum": "*", "probe": "1", "service": self.name}
        try:
            return node.graph.transport.probe_service(uri, header, node.uri).get("type", _OTHER)
        except TransportException:
            return _OTHER

    def wait_for_service(self, timeout: float | None = None) -> None:
        """Block until the service is available. Raises ``ROSException`` after ``timeout`` seconds."""
        self.node.services.wait_for(self.name, timeout)

    def close(self) -> None:
        """Close the connection of a persistent client, which then cannot be used any more."""
        link, self._link = self._link, None
        self._closed = self.persistent
        if link is not None:
            link.close()


def timed_out(seconds: float, what: str) -> ROSException:
    """Return the exception for a wait for ``what`` that timed out after ``seconds``."""
    return ROSException(f"timeout exceeded after {seconds:g} s while waiting for {what}")
