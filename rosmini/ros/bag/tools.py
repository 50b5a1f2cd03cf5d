"""Operations of ``rosbag`` on whole bags: filter, compress, reindex, check, and fix, which migrates changed types.

Except by fix, connection headers are kept byte for byte. ROS's fix reads rule files, which are programs; without a
rule it matches fields by name, as is done here (http://wiki.ros.org/rosbag/migration).
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.errors import shown
from rosmini.core.expressions import ExpressionError
from rosmini.core.time import Time
from rosmini.msgs.message import Message
from rosmini.ros.introspection.filters import message_expression

from .bag import Bag
from .errors import FilterError, ROSBagException
from .index import Connection, connection
from .records import Compression
from .types import local_class, recorded_class, serialized

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from .reader import RawMessage

    PathLike = str | os.PathLike[str]


class Copied(NamedTuple):
    """Number of messages written, and the total number."""

    written: int
    total: int


class Reindexed(NamedTuple):
    """Number of messages in a bag after reindexing, and its problems."""

    messages: int
    problems: list[str]


class TypeChange(NamedTuple):
    """A type whose md5 sum in the bag, ``md5sum``, differs from this system's, ``local`` (None: unknown here)."""

    type: str
    md5sum: str
    local: str | None
    topics: tuple[str, ...]

    def __str__(self) -> str:
        where = f"{self.type} [{self.md5sum}] on {', '.join(self.topics)}"
        if self.local is None:
            known = "it can be read and played with the bag's own definition"
            return f"{where}: this system does not know the type; {known}"
        return f"{where}: here it is [{self.local}]; nodes that use that one do not get what the bag has"


def copy_messages(
    messages: Iterable[RawMessage], target: Bag, keep: Callable[[RawMessage], object] | None = None
) -> Copied:
    """Write the messages of other bags that ``keep`` accepts into ``target``."""
    written = total = 0
    for message in messages:
        total += 1
        if keep is None or keep(message):
            target.write_raw(target.connect(message.connection), message.time, message.data)
            written += 1
    return Copied(written, total)


def two_files(source: PathLike, target: PathLike) -> None:
    """Raise ``ROSBagException`` if a bag would overwrite itself."""
    if Path(source).resolve() == Path(target).resolve():
        raise ROSBagException(f"Cannot use same file as input and output [{os.fspath(source)}]")


def filter_bag(
    source: PathLike,
    target: PathLike,
    expression: str | Callable[[str, Any, Time], object],
    *,
    tell: Callable[[bool, str, Any, Time], object] | None = None,
) -> Copied:
    """Write the messages of ``source`` for which an expression of ``topic``, ``m`` and ``t`` is true to ``target``.

    The expression is text, restricted as by :func:`compile_expression`, or a function. ``tell(kept, topic, m, t)`` is
    called for each message. Raises ``FilterError``, without writing ``target``, for an expression that fails.
    """
    two_files(source, target)
    chosen = compile_expression(expression) if isinstance(expression, str) else expression
    with Bag(source) as inbag:

        def keep(message: RawMessage) -> bool:
            content = inbag.message_class(message.connection)._thaw(inbag.decode(message))
            time = Time.from_nsec(message.time)
            kept = bool(chosen(message.connection.topic, content, time))
            if tell is not None:
                tell(kept, message.connection.topic, content, time)
            return kept

        return write_whole(target, lambda outbag: copy_messages(inbag.read_raw(), outbag, keep))


def compile_expression(text: str) -> Callable[[str, Any, Any], Any]:
    """Return ``f(topic, m, t)`` that evaluates an expression of ``rosbag filter`` on a message.

    ROS's tool evaluates any Python. Here the expression can only compute with the names that
    :mod:`rosmini.ros.introspection.filters` allows.

    Raises ``FilterError``, which says what is not allowed or where the expression is incomplete. The function raises it
    as well if the expression fails on a message (a field that this type does not have, for instance), or needs too much
    time or memory.
    """
    try:
        expression = message_expression(text, ("topic", "m", "t"))
    except ExpressionError as error:
        raise FilterError(f"{shown(text)}: {error}. An example: topic == '/scan' and t.secs > 5") from error

    def evaluate(topic: str, m: Any, t: Any) -> Any:
        try:
            return expression.evaluate({"topic": topic, "m": m, "t": t})
        except ExpressionError as error:
            kind = getattr(m, "_type", type(m).__name__)
            is_tested = repr(topic) in text or f'"{topic}"' in text
            advice = "" if is_tested else " Test the topic first: topic == '...' and ..."
            raise FilterError(f"{shown(text)} failed on a {kind} of {topic}: {error}.{advice}") from error

    return evaluate


def write_whole(target: PathLike, fill: Callable[[Bag], Copied], compression: str = Compression.NONE) -> Copied:
    """Write a new bag with ``fill`` and return its result; remove the bag if it fails."""
    part = Path(f"{os.fspath(target)}.part")
    try:
        with Bag(part, "w", compression) as outbag:
            result = fill(outbag)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)
    return result


def recompress(source: PathLike, target: PathLike, compression: str = Compression.BZ2) -> Copied:
    """Write the messages of ``source`` to ``target`` with another compression ("none": uncompressed)."""
    two_files(source, target)
    with Bag(source) as inbag:
        return write_whole(target, lambda outbag: copy_messages(inbag.read_raw(), outbag), compression)


def reindex(path: PathLike) -> Reindexed:
    """Make a new index for a bag, in place.

    Truncated or damaged data at its end is dropped, everything else is kept.

    Raises ``ROSBagException`` if the file is not a bag, or is encrypted.
    """
    with Bag(path, "a", allow_unindexed=True) as bag:
        problems = bag.problems
    with Bag(path) as bag:
        return Reindexed(bag.get_message_count(), problems)


def changed_types(bag: Bag) -> list[TypeChange]:
    """Return the types in a bag that differ from this system's, sorted."""
    return sorted(_changes(bag), key=lambda change: (change.type, change.md5sum))


def _changes(bag: Bag) -> Iterator[TypeChange]:
    topics: dict[tuple[str, str], list[str]] = {}
    local: dict[tuple[str, str], str | None] = {}
    for conn in bag.connections():
        cls = local_class(conn)
        if cls is None or cls._md5sum != conn.md5sum:
            key = conn.type, conn.md5sum
            topics.setdefault(key, []).append(conn.topic)
            local[key] = None if cls is None else cls._md5sum
    for (kind, md5sum), names in topics.items():
        yield TypeChange(kind, md5sum, local[kind, md5sum], tuple(sorted(set(names))))


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
