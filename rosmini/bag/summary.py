"""What a bag tells of itself, as ``rosbag.Bag`` does, and the tuples in which it answers."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from rosmini.errors import nearest
from rosmini.names import canonicalize
from rosmini.time import Time

from .errors import ROSBagException
from .index import Connection
from .info import frequency, info_text, info_yaml

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .index import Index
    from .reader import Reader
    from .types import Types

    ConnectionFilter = Callable[[str, str, str, str, dict[str, bytes]], bool]


class BagMessage(NamedTuple):
    """What :meth:`Bag.read_messages` yields."""

    topic: str
    message: Any
    timestamp: Time


class BagMessageWithConnectionHeader(NamedTuple):
    """What :meth:`Bag.read_messages` yields with ``return_connection_header``; the header's values are bytes."""

    topic: str
    message: Any
    timestamp: Time
    connection_header: dict[str, bytes]


class CompressionTuple(NamedTuple):
    """How most chunks are compressed, and how many bytes all are without and with it."""

    compression: str
    uncompressed: int
    compressed: int


class TopicTuple(NamedTuple):
    """What a bag has of a topic; ``frequency`` is one over the median period [Hz], None if there is none."""

    msg_type: str
    message_count: int
    connections: int
    frequency: float | None


class TypesAndTopicsTuple(NamedTuple):
    """The md5 sums of the types by name, and what there is of each topic."""

    msg_types: dict[str, str]
    topics: dict[str, TopicTuple]


class _Open(Protocol):
    """What a summary needs of a bag."""

    _types: Types

    @property
    def _name(self) -> str: ...
    @property
    def index(self) -> Index: ...
    @property
    def compression(self) -> str: ...
    def connections(self, topics: Any = None) -> list[Connection]: ...
    def no_topic(self, topic: str) -> ROSBagException: ...
    def reader(self) -> Reader: ...


class Summaries:
    """The methods of a bag that only look at its index."""

    def connections(
        self: _Open,
        topics: str | Iterable[str] | None = None,
        connection_filter: ConnectionFilter | None = None,
    ) -> list[Connection]:
        """Return the connections of one topic, some, or all; ``connection_filter(topic, type, md5, definition, header)`` chooses."""
        if isinstance(topics, str):
            topics = [topics]
        names = None if not topics else {name for topic in topics for name in (topic, canonicalize(topic))}
        return [
            found
            for found in self.index.connections.values()
            if (names is None or found.topic in names or canonicalize(found.topic) in names)
            and (
                connection_filter is None
                or connection_filter(
                    found.topic, found.type, found.md5sum, found.definition, dict(found.header)
                )
            )
        ]

    def message_class(self: _Open, topic_or_connection: str | Connection) -> Any:
        """Return the class of the messages on a topic. Raises ``ROSBagException``, with the nearest name, for an unknown topic."""
        if isinstance(topic_or_connection, Connection):
            return self._types.of(topic_or_connection)
        found = self.connections(topic_or_connection)
        if not found:
            raise self.no_topic(topic_or_connection)
        return self._types.of(found[0])

    def no_topic(self: _Open, topic: str) -> ROSBagException:
        """Return the error for a topic that is not in the bag."""
        topics = sorted({found.topic for found in self.index.connections.values()})
        hint = nearest(topic, topics) or f"it has {', '.join(topics) or 'no topics'}"
        return ROSBagException(f"{self._name} has no topic {topic}: {hint}")

    def get_message_count(self: _Open, topic_filters: str | list[str] | None = None) -> int:
        """Return how many messages there are, on one topic, some, or all."""
        if topic_filters is None:
            return self.index.messages
        return sum(self.index.count(found.id) for found in self.connections(topic_filters))

    def get_start_time(self: _Open) -> float:
        """Return when the first message was recorded [s]. Raises ``ROSBagException`` if there is none."""
        return _time(self.index.start)

    def get_end_time(self: _Open) -> float:
        """Return when the last message was recorded [s]. Raises ``ROSBagException`` if there is none."""
        return _time(self.index.end)

    def get_compression_info(self: _Open) -> CompressionTuple:
        """Return how most chunks are compressed, and their bytes without and with it."""
        chunks = self.index.chunks
        ranked = sorted(
            ((count, name) for name, count in Counter(chunk.compression for chunk in chunks).items()),
            reverse=True,
        )
        return CompressionTuple(
            ranked[0][1] if ranked else self.compression,
            sum(chunk.size for chunk in chunks),
            sum(chunk.compressed for chunk in chunks),
        )

    def get_type_and_topic_info(
        self: _Open, topic_filters: str | list[str] | None = None
    ) -> TypesAndTopicsTuple:
        """Return the types, and what there is of one topic, some, or all."""
        reader = self.reader()
        types: dict[str, str] = {}
        for found in self.index.connections.values():
            types.setdefault(found.type, found.md5sum)
        topics = {}
        for topic in sorted({found.topic for found in self.connections(topic_filters)}):
            here = self.connections(topic)
            topics[topic] = TopicTuple(
                here[0].type,
                sum(self.index.count(found.id) for found in here),
                len(here),
                frequency(reader, here),
            )
        return TypesAndTopicsTuple(dict(sorted(types.items())), topics)

    def info(self: Any, *, freq: bool = False, utc: bool = False) -> str:
        """Return what ``rosbag info`` prints; with how often messages came if asked for, with times of UTC or of this machine's zone."""
        return info_text(self, freq=freq, utc=utc)

    def __str__(self: Any) -> str:
        return info_text(self)

    def _get_yaml_info(self: Any, key: str | None = None) -> str | None:
        return info_yaml(self, key)


def _time(nanoseconds: int | None) -> float:
    if nanoseconds is None:
        raise ROSBagException("Bag contains no message")
    return Time.from_nsec(nanoseconds).to_sec()
