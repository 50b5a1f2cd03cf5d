"""`rqt_msg`, `rqt_srv`, `rqt_action`: the fields of a type as a tree (wiki.ros.org/rqt_msg, rqt_srv, rqt_action)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from optparse import Values
from typing import Any, ClassVar

from rosmini.core.errors import DefinitionError, IllegalName, UnknownPackage, UnknownType
from rosmini.core.graph import Graph
from rosmini.core.verbs import Call
from rosmini.msgs.definition import MessageSpec
from rosmini.msgs.registry import registry
from rosmini.viz.rqt.table import Table
from rosmini.viz.view import View, ViewError

from .panel import Panel, bar
from .parts import Control, Part, Row, Rows

COLUMNS = ("Tree", "Type", "Path")


def rqt_msg(kind: str, *, title: str | None = None) -> Table:
    """Show the fields of a message type: "geometry_msgs/Twist". Raises ``ViewError`` if it is not known."""
    return _table(kind, title, lambda: [("", registry().definition(kind))])


def rqt_srv(kind: str, *, title: str | None = None) -> Table:
    """Show request and response of a service type. Raises ``ViewError`` if it is not known."""

    def halves() -> list[tuple[str, MessageSpec]]:
        found = registry().service_definition(kind)
        return [("Request", found.request), ("Response", found.response)]

    return _table(kind, title, halves)


def rqt_action(kind: str, *, title: str | None = None) -> Table:
    """Show goal, result and feedback of an action type. Raises ``ViewError`` if it is not known."""
    parts = ("Goal", "Result", "Feedback")
    return _table(kind, title, lambda: [(part, registry().definition(f"{kind}{part}")) for part in parts])


def _table(kind: str, title: str | None, parts: Callable[[], list[tuple[str, MessageSpec]]]) -> Table:
    if kind.count("/") != 1:
        raise ViewError(f"{kind!r} is not a type: write package/Type, as in geometry_msgs/Twist")
    try:
        found = parts()
        rows: list[Row] = []
        for part, spec in found:
            head, path = f"{kind}{part}", part.lower() and f"{part.lower()}/"
            rows.append(Row((head, head, head)))
            rows += [Row((name, type_, f"{path}{where}"), depth) for depth, name, type_, where in _fields(spec)]
    except (UnknownType, UnknownPackage, DefinitionError, IllegalName) as error:
        raise ViewError(str(error)) from error
    table = Rows(COLUMNS, tuple(rows), f"Fields of {kind}")
    return Table(table, title=title or kind, noun="part" if len(found) > 1 else "type")


def _fields(spec: MessageSpec, depth: int = 1, path: str = "") -> Iterator[tuple[int, str, str, str]]:
    for field in spec.fields:
        where = f"{path}{field.ros_name}"
        yield depth, field.ros_name, field.type, where
        if not field.builtin:
            yield from _fields(registry().definition(field.base), depth + 1, f"{where}/")


class _TypeBrowser(Panel):
    """The fields of a type."""

    usage = "TYPE"
    table: ClassVar[Callable[..., Table]]
    """Function that returns the fields of a type."""

    def __init__(self, graph: Graph, kind: str = "", *, name: str | None = None) -> None:
        super().__init__(graph, name=name)
        self.choose(kind or self.example)

    @classmethod
    def arguments(cls, given: Values) -> tuple[list[str], dict[str, Any]]:
        """Return the type."""
        return given.words, {}

    @classmethod
    def still(cls, given: Values, call: Call) -> View:
        """Return the fields of a type."""
        del call
        return cls.table(given.words[0], title=given.title)

    def choose(self, kind: str) -> None:
        """Show another type. Raises ``ViewError`` if no package here defines it."""
        self._table = type(self).table(kind)
        self.kind = kind

    def parts(self) -> Sequence[Part]:
        """The type, and its fields."""
        return [bar(Control("type", "Type", "text", self.kind)), self._table.part]

    def _operate(self, _key: Sequence[str], value: Any) -> None:
        self.choose(value)

    def settings(self) -> dict[str, Any]:
        """Return the type."""
        return {"type": self.kind}

    def restore(self, settings: dict[str, Any]) -> None:
        """Show the type of a perspective."""
        self.choose(str(settings.get("type", self.kind)))


class MessageTypes(_TypeBrowser):
    """The fields of a message type (http://wiki.ros.org/rqt_msg)."""

    tool, heading, plugin = "rqt_msg", "Message Type Browser", "rqt_msg/Messages"
    group, summary = "Topics", "the fields of a message type"
    takes, example = "msg", "geometry_msgs/Twist"
    table = staticmethod(rqt_msg)


class ServiceTypes(_TypeBrowser):
    """The fields of a service type (http://wiki.ros.org/rqt_srv)."""

    tool, heading, plugin = "rqt_srv", "Service Type Browser", "rqt_srv/Services"
    group, summary = "Services", "the fields of a service type"
    takes, example = "srv", "nav_msgs/GetPlan"
    table = staticmethod(rqt_srv)


class ActionTypes(_TypeBrowser):
    """The fields of an action type (http://wiki.ros.org/rqt_action)."""

    tool, heading, plugin = "rqt_action", "Action Type Browser", "rqt_action/ActionPlugin"
    group, summary = "Actions", "the fields of an action type"
    takes, example = "", "move_base_msgs/MoveBase"
    table = staticmethod(rqt_action)
