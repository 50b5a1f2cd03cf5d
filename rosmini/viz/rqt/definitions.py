"""`rqt_msg`, `rqt_srv`, `rqt_action`: the fields of a type as a tree (wiki.ros.org/rqt_msg, rqt_srv, rqt_action)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rosmini.core.errors import DefinitionError, IllegalName, UnknownPackage, UnknownType
from rosmini.msgs.registry import registry
from rosmini.viz.rqt.table import Table
from rosmini.viz.view import ViewError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.msgs.definition import MessageSpec

COLUMNS = ("Tree", "Type", "Path")


def rqt_msg(kind: str) -> Table:
    """Show the fields of a message type: "geometry_msgs/Twist". Raises ``ViewError`` if it is not known."""
    return _table(kind, lambda: [("", registry().definition(kind))])


def rqt_srv(kind: str) -> Table:
    """Show request and response of a service type. Raises ``ViewError`` if it is not known."""

    def halves() -> list[tuple[str, MessageSpec]]:
        found = registry().service_definition(kind)
        return [("Request", found.request), ("Response", found.response)]

    return _table(kind, halves)


def rqt_action(kind: str) -> Table:
    """Show goal, result and feedback of an action type. Raises ``ViewError`` if it is not known."""
    parts = ("Goal", "Result", "Feedback")
    return _table(kind, lambda: [(part, registry().definition(f"{kind}{part}")) for part in parts])


def _table(kind: str, parts: Callable[[], list[tuple[str, MessageSpec]]]) -> Table:
    if kind.count("/") != 1:
        raise ViewError(f"{kind!r} is no type: one is written package/Type, as in geometry_msgs/Twist")
    try:
        found = parts()
        rows: list[tuple[str, str, str]] = []
        for part, spec in found:
            head, path = f"{kind}{part}", part.lower() and f"{part.lower()}/"
            rows.append((head, head, head))
            rows += [
                (f"{'  ' * depth}{name}", type_, f"{path}{where}")
                for depth, name, type_, where in _fields(spec)
            ]
    except (UnknownType, UnknownPackage, DefinitionError, IllegalName) as error:
        raise ViewError(str(error)) from error
    return Table(COLUMNS, rows, title=kind, noun="part" if len(found) > 1 else "type")


def _fields(spec: MessageSpec, depth: int = 1, path: str = "") -> Iterator[tuple[int, str, str, str]]:
    for field in spec.fields:
        where = f"{path}{field.ros_name}"
        yield depth, field.ros_name, field.type, where
        if not field.builtin:
            yield from _fields(registry().definition(field.base), depth + 1, f"{where}/")
