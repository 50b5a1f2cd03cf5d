"""`rqt_service_caller`: call a service with values from a form (http://wiki.ros.org/rqt_service_caller)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rosmini.core.errors import ServiceException, TransportException, nearest
from rosmini.core.graph import Graph
from rosmini.ros.introspection.fields import service_class_of
from rosmini.ros.introspection.services import services, type_of
from rosmini.viz.rqt.topics import value_text
from rosmini.viz.view import ViewError

from .fields import Fields, value_table
from .panel import Panel, bar
from .parts import Box, Control, Part


class ServiceCaller(Panel):
    """A form for the request of a service, which shows the response.

    >>> from rosmini import Graph
    >>> from rosmini.msgs.std_srvs.srv import SetBool
    >>> graph = Graph()
    >>> lamp = graph.node("lamp")
    >>> _ = lamp.service("switch", SetBool, lambda request: (request.data, "it is on" if request.data else "it is off"))
    >>> caller = ServiceCaller(graph, service="/switch")
    >>> caller.fill("data", "True")
    >>> caller.call().message
    'it is on'

    Args:
        graph: the graph.
        service: service shown at first.
        name: name of the panel's node.

    Raises:
        ViewError: there is no such service, or its type is unknown here.

    """

    tool, heading, plugin = "rqt_service_caller", "Service Caller", "rqt_service_caller/ServiceCaller"
    group, summary = "Services", "call services, from a form"
    usage, takes = "[SERVICE]", "service"
    instead = "rosservice call /SERVICE VALUES"

    def __init__(self, graph: Graph, service: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.service = ""
        self._type: Any = None
        self._fields: Fields | None = None
        self.response: Any = None
        """Last response of the service."""
        self._calls = 0
        if service:
            self.choose(service)

    def names(self) -> list[str]:
        """Return the names of all services, sorted; the logger services of every node come last."""
        found = sorted(each.name for each in services(self.graph))
        return sorted(found, key=lambda name: name.endswith(("/get_loggers", "/set_logger_level")))

    def choose(self, service: str) -> None:
        """Choose another service. Raises ``ViewError``."""
        if service not in self.names():
            hint = nearest(service, self.names()) or "`rosservice list` lists those that there are"
            raise ViewError(f"no node offers a service {service!r:.80}; {hint}")
        try:
            kind = type_of(self.graph, service)
        except TransportException as error:
            raise ViewError(f"the server of {service} does not answer: {error}") from error
        cls = service_class_of(kind) if kind else None
        if cls is None:
            raise ViewError(f"{service} is a {kind or 'service of an unknown type'}, which no package here defines")
        self.service, self._type, self._fields, self.response = service, cls, Fields(cls._request_class), None

    def fill(self, field: str, expression: str) -> None:
        """Give a field of the request a value. Raises ``ViewError``."""
        self._form.fill(field, expression)

    def call(self) -> Any:
        """Call the service, and return the response. Raises ``ViewError``, ``ServiceException``."""
        self._require()
        request = self._form.message(self._calls)
        self._calls += 1
        self.response = None
        try:
            self.response = self.node.service_client(self.service, self._type, numpy=False).call(request)
        except ServiceException as error:
            raise ServiceException(f"{self.service} gave no answer: {error}") from error
        return self.response

    @property
    def _form(self) -> Fields:
        if self._fields is None:
            raise ViewError("no service is chosen: choose() one of those in names()")
        return self._fields

    def parts(self) -> Sequence[Part]:
        """The service, its request, and its response."""
        choices = tuple(dict.fromkeys((self.service, *self.names())))
        service = Control("service", "Service", "choice", self.service, choices)
        if self._fields is None:
            return [bar(service)]
        found: list[Part] = [
            bar(service, Control("call", "Call", "button"), f"[{self._type._type}]"),
            Box("Request", (self._fields.table("request"),)),
        ]
        if self.response is not None:
            found.append(Box("Response", (value_table(self.response, value_text),)))
        return found

    def settings(self) -> dict[str, Any]:
        """Return the service."""
        return {"service": self.service}

    def restore(self, settings: dict[str, Any]) -> None:
        """Choose the service."""
        if settings.get("service"):
            self.choose(str(settings["service"]))

    def _operate(self, key: Sequence[str], value: Any) -> None:
        if key[0] == "service":
            self.choose(value)
        elif key[0] == "call":
            self.call()
        else:
            self.fill("/".join(key[1:]), value)
