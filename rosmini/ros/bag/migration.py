"""Migrate bags whose message types have changed: convert messages to this system's types, field by field.

ROS's tool reads rule files, which are programs; without a rule it matches fields by name, as this module does
(http://wiki.ros.org/rosbag/migration).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.msgs.message import Message

from .bag import Bag
from .index import connection
from .tools import Copied, TypeChange, changed_types, two_files, write_whole
from .types import local_class, recorded_class, serialized

if TYPE_CHECKING:
    from collections.abc import Callable

    from .index import Connection
    from .reader import RawMessage
    from .tools import PathLike


class Fixed(NamedTuple):
    """Result for one bag: the copied counts, None if it was not written, and the obstacles of each type."""

    copied: Copied | None
    obstacles: dict[TypeChange, tuple[str, ...]]


def differences(old: Any, new: Any, path: str = "") -> list[str]:
    """Return the fields of a message class that the other cannot take, or lacks: a line for each."""
    was, now = _types(old), _types(new)
    found = [f"the field {path}{name} is gone" for name in was if name not in now]
    found += [f"the field {path}{name} is new" for name in now if name not in was]
    for name in was.keys() & now.keys():
        before, after = was[name], now[name]
        inner = _nested(old, before), _nested(new, after)
        if all(inner) and before.partition("[")[1:] == after.partition("[")[1:]:
            found += differences(*inner, f"{path}{name}/")
        elif before != after:
            found.append(f"the field {path}{name} was {before} and is {after}")
    return sorted(found)


def migrated(message: Any, new: Any) -> Any:
    """Return a message converted to another class: fields of the same name and type keep their values."""
    old = type(message)
    made, was, now = new(), _types(old), _types(new)
    for name in was.keys() & now.keys():
        inner = _nested(new, now[name])
        value = getattr(message, name)
        if inner is not None and isinstance(value, Message):
            setattr(made, name, migrated(value, inner))
        elif inner is not None and isinstance(value, list | tuple):
            setattr(made, name, [migrated(one, inner) for one in value])
        elif was[name] == now[name]:
            setattr(made, name, value)
    return made


def _types(cls: Any) -> dict[str, str]:
    return dict(zip(cls.__slots__, cls._slot_types, strict=True))


def _nested(cls: Any, kind: str) -> Any:
    """Return the class of a field that holds messages, None for any other field."""
    return cls._nested.get(kind.partition("[")[0])


def fix_bag(source: PathLike, target: PathLike, *, force: bool = False) -> Fixed:
    """Write a bag with its messages converted to this system's types; types unknown here are copied as they are.

    If fields do not match, nothing is written, except with ``force``: then new fields are empty, and removed fields are
    lost. Raises ``ROSBagException``.
    """
    two_files(source, target)
    with Bag(source) as inbag:
        obstacles: dict[TypeChange, tuple[str, ...]] = {}
        changes = {(change.type, change.md5sum): change for change in changed_types(inbag)}
        for conn in inbag.connections():
            change, local = changes.get((conn.type, conn.md5sum)), local_class(conn)
            if change is not None and local is not None:
                found = differences(recorded_class(conn), local)
                obstacles.update({change: tuple(found)} if found else {})
        if obstacles and not force:
            return Fixed(None, obstacles)
        return Fixed(write_whole(target, lambda outbag: _copy(inbag, outbag)), obstacles)


def _copy(inbag: Bag, outbag: Bag) -> Copied:
    writers: dict[int, Callable[[RawMessage], None]] = {}
    count = 0
    for message in inbag.read_raw():
        conn = message.connection
        if conn.id not in writers:
            writers[conn.id] = _writer(conn, inbag, outbag)
        writers[conn.id](message)
        count += 1
    return Copied(count, count)


def _writer(conn: Connection, inbag: Bag, outbag: Bag) -> Callable[[RawMessage], None]:
    """Return a function that writes the messages of a connection."""
    local = local_class(conn)
    if local is None or local._md5sum == conn.md5sum:
        number = outbag.connect(conn)
        return lambda message: outbag.write_raw(number, message.time, message.data)
    recorded = recorded_class(conn)
    fields = {name: value for name, value in conn.header.items() if name not in ("md5sum", "message_definition")}
    header = {**fields, "md5sum": local._md5sum, "message_definition": local._full_text}
    changed = outbag.connect(connection(0, conn.topic, header))

    def write(message: RawMessage) -> None:
        content = recorded._thaw(inbag.decode(message))
        outbag.write_raw(changed, message.time, serialized(migrated(content, local)))

    return write
