"""Operations of ``rosbag`` on whole bags: filter, compress, reindex, check.

Connection headers are kept byte for byte.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.time import Time

from .bag import Bag
from .errors import ROSBagException
from .expressions import compile_expression
from .records import Compression
from .types import local_class

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

    The expression is text, restricted as in :mod:`rosmini.ros.bag.expressions`, or a function. ``tell(kept, topic, m,
    t)``
    is called for each message. Raises ``FilterError``, without writing ``target``, for an expression that fails.
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
