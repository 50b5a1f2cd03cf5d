"""Summary of a bag from its index, as ``rosbag.Bag`` provides it, and the tuples it returns."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from rosmini.core.errors import nearest
from rosmini.core.names import canonicalize
from rosmini.core.time import Time

from .errors import ROSBagException
from .index import Connection

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from .index import Index
    from .reader import Reader
    from .types import Types

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


class Summaries(Protocol):
    """Methods of a bag that only inspect or display it, and the attributes that they need."""

    _types: Types

    @property
    def _name(self) -> str: ...
    @property
    def filename(self) -> str | None:
        """Path of the file."""

    @property
    def version(self) -> int:
        """Version of the format: 200 for 2.0."""

    @property
    def size(self) -> int:
        """Length of the file [bytes]."""

    @property
    def index(self) -> Index:
        """The connections and chunks."""

    @property
    def compression(self) -> str:
        """Compression of the chunks written from now on."""

    def reader(self) -> Reader:
        """Return the reader of the bag."""

    def connections(
        self,
        topics: str | Iterable[str] | None = None,
        connection_filter: ConnectionFilter | None = None,
    ) -> list[Connection]:
        """Return the connections of one, several or all topics.

        ``connection_filter(topic, type, md5, definition, header)`` selects among them.
        """
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

    def message_class(self, topic_or_connection: str | Connection) -> Any:
        """Return the class of the messages on a topic.

        Raises ``ROSBagException``, which suggests similar names, for an unknown topic.
        """
        if isinstance(topic_or_connection, Connection):
            return self._types.of(topic_or_connection)
        found = self.connections(topic_or_connection)
        if not found:
            raise self.no_topic(topic_or_connection)
        return self._types.of(found[0])

    def no_topic(self, topic: str) -> ROSBagException:
        """Return the error for a topic that is not in the bag."""
        topics = sorted({found.topic for found in self.index.connections.values()})
        hint = nearest(topic, topics) or f"it has {', '.join(topics) or 'no topics'}"
        return ROSBagException(f"{self._name} has no topic {topic}: {hint}")

    def get_message_count(self, topic_filters: str | list[str] | None = None) -> int:
        """Return the number of messages on one, several or all topics."""
        if topic_filters is None:
            return self.index.messages
        return sum(self.index.count(found.id) for found in self.connections(topic_filters))

    def get_start_time(self) -> float:
        """Return the time of the first message [s]. Raises ``ROSBagException`` for an empty bag."""
        return _time(self.index.start)

    def get_end_time(self) -> float:
        """Return the time of the last message [s]. Raises ``ROSBagException`` for an empty bag."""
        return _time(self.index.end)

    def get_compression_info(self) -> CompressionTuple:
        """Return the compression of most chunks, and the number of bytes without and with it."""
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

    def get_type_and_topic_info(self, topic_filters: str | list[str] | None = None) -> TypesAndTopicsTuple:
        """Return the types, and the summaries of one, several or all topics."""
        return TypesAndTopicsTuple(self.md5sums(), self.topics(topic_filters))

    def md5sums(self) -> dict[str, str]:
        """Return the md5 sum of each type, sorted by name."""
        found: dict[str, str] = {}
        for connection in self.index.connections.values():
            found.setdefault(connection.type, connection.md5sum)
        return dict(sorted(found.items()))

    def topics(
        self, topic_filters: str | list[str] | None = None, *, freq: bool = True
    ) -> dict[str, TopicTuple]:
        """Return the summaries of one, several or all topics by name; frequencies require reading all index data."""
        reader = self.reader()
        topics = {}
        for topic in sorted({found.topic for found in self.connections(topic_filters)}):
            here = self.connections(topic)
            count = sum(self.index.count(found.id) for found in here)
            topics[topic] = TopicTuple(
                here[0].type, count, len(here), _frequency(reader, here) if freq else None
            )
        return topics

    def show(self, **options: Any) -> Any:
        """Return a picture of the bag's messages over time, like that of ``rqt_bag``.

        Options and their defaults:
            topics=None: only these topics; None: all
            gap=3.0: a pause is a gap if it is this many times the usual one, and a hundredth of the bag
            title=None: a caption under the picture, and the first words of its text form
            width=660.0: width of the picture [CSS px]
        """
        from rosmini.core.graph.show import show

        return show("bag", self, **options)

    def replay(self, **options: Any) -> Any:
        """Return a player that shows the bag from above: robots, maps, plans, particles, scans, markers.

        Options and their defaults:
            title=None: a caption under the player, and the first words of its text form
            names=None: a list with the run's name
            topics=None: only these topics; None: all that can be shown
            frame=None: frame in which everything is drawn; None: map, odom or world, the first that exists
            robot=None: appearance of robots from above: a model or its name; None: an arrow head
        """
        from rosmini.core.graph.show import show

        return show("replay", self, **options)


def _frequency(reader: Reader, connections: Iterable[Connection]) -> float | None:
    """Return one over the median period [Hz]; None for fewer than two messages, or all at one time."""
    # to_sec(), as in ROS: the last bit of a float shows if messages are microseconds apart
    stamps = sorted(Time.from_nsec(stamp).to_sec() for conn in connections for stamp in reader.times(conn.id))
    periods = sorted(after - before for before, after in pairwise(stamps))
    if not periods:
        return None
    middle = len(periods) // 2
    median = periods[middle] if len(periods) % 2 else (periods[middle - 1] + periods[middle]) / 2
    return 1 / median if median > 0 else None


def _time(nanoseconds: int | None) -> float:
    if nanoseconds is None:
        raise ROSBagException("Bag contains no message")
    return Time.from_nsec(nanoseconds).to_sec()
