"""The tuples that ``rosbag.Bag`` returns about messages and topics, and what is in them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

from rosmini.core.time import Time

from .errors import ROSBagException

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .index import Connection
    from .reader import Reader

    ConnectionFilter = Callable[[str, str, str, str, dict[str, bytes]], bool]


class BagMessage(NamedTuple):
    """Item yielded by :meth:`Bag.read_messages`."""

    topic: str
    message: Any
    timestamp: Time


class BagMessageWithConnectionHeader(NamedTuple):
    """Item yielded by :meth:`Bag.read_messages` with ``return_connection_header``; the header's values are bytes."""

    topic: str
    message: Any
    timestamp: Time
    connection_header: dict[str, bytes]


class CompressionTuple(NamedTuple):
    """Compression of most chunks, and the total number of bytes without and with compression."""

    compression: str
    uncompressed: int
    compressed: int


class TopicTuple(NamedTuple):
    """Summary of a topic; ``frequency`` is one over the median period [Hz], or None if unknown."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None


class TypesAndTopicsTuple(NamedTuple):
    """The md5 sums of the types by name, and the topics by name."""

    msg_types: dict[str, str]
    topics: dict[str, TopicTuple]


def frequency(reader: Reader, connections: Iterable[Connection]) -> float | None:
    """Return one over the median period [Hz]; None for fewer than two messages, or all at one time."""
    # to_sec(), as in ROS: the last bit of a float shows if messages are microseconds apart
    stamps = sorted(Time.from_nsec(stamp).to_sec() for conn in connections for stamp in reader.times(conn.id))
    periods = sorted(after - before for before, after in pairwise(stamps))
    if not periods:
        return None
    middle = len(periods) // 2
    median = periods[middle] if len(periods) % 2 else (periods[middle - 1] + periods[middle]) / 2
    return 1 / median if median > 0 else None


def seconds(nanoseconds: int | None) -> float:
    """Return a time [s]. Raises ``ROSBagException`` for the missing time of an empty bag."""
    if nanoseconds is None:
        raise ROSBagException("Bag contains no message")
    return Time.from_nsec(nanoseconds).to_sec()
