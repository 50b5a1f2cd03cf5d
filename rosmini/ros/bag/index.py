"""The index of a bag: connections, chunks, and the position of each message in its chunk."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from .errors import ROSBagFormatException
from .records import pack_fields, parse_fields


@dataclass(frozen=True)
class Connection:
    """A recorded connection of a publisher: its topic, and its header byte for byte.

    ``raw`` holds the fields of the connection header (http://wiki.ros.org/ROS/Connection%20Header) as they are in the
    file.
    """

    id: int
    topic: str
    raw: bytes
    place: str = field(default="", compare=False)
    """File and position from which it was read."""

    @cached_property
    def header(self) -> dict[str, bytes]:
        """Fields of the connection header."""
        return parse_fields(self.raw, self.place or f"the connection of {self.topic}")

    def text(self, name: str) -> str:
        """Return a header field as text; empty if there is no such field."""
        return self.header.get(name, b"").decode("utf-8", "replace")

    @cached_property
    def type(self) -> str:
        """The message type, such as ``std_msgs/String``."""
        return self.text("type")

    @cached_property
    def md5sum(self) -> str:
        """The md5 sum of the message definition."""
        return self.text("md5sum")

    @cached_property
    def definition(self) -> str:
        """The full text of the message definition."""
        return self.text("message_definition")

    @property
    def caller(self) -> str:
        """Name of the publishing node; empty if the bag does not record it."""
        return self.text("callerid")

    @property
    def latching(self) -> bool:
        """True if the publisher latched its last message."""
        return self.text("latching") == "1"

    def fits(self, topics: Iterable[str] | None) -> bool:
        """Return True if the topic is one of ``topics`` (None: all topics)."""
        return topics is None or self.topic in topics


def connection(number: int, topic: str, header: Mapping[str, str | bytes]) -> Connection:
    """Return a connection made from header fields."""
    raw = {name: value if isinstance(value, bytes) else str(value).encode() for name, value in header.items()}
    for needed in ("type", "md5sum", "message_definition"):
        if needed not in raw:
            raise ROSBagFormatException(f"the connection header of {topic} has no field {needed!r}")
    if "topic" not in raw:
        raw = {"topic": topic.encode(), **raw}
    return Connection(number, topic, pack_fields(raw))


@dataclass
class Chunk:
    """A chunk: its position, the times it spans [ns], and its number of messages for each connection."""

    position: int
    data_position: int
    compression: str
    compressed: int
    size: int
    start: int = 0
    end: int = 0
    counts: dict[int, int] = field(default_factory=dict)
    entries: dict[int, bytes] | None = None
    """Packed (seconds, nanoseconds, offset) of each connection's messages; None while they are only in the file."""

    @property
    def messages(self) -> int:
        """Number of messages in the chunk."""
        return sum(self.counts.values())


@dataclass
class Index:
    """All connections by number, and all chunks in the order in which they were written."""

    connections: dict[int, Connection] = field(default_factory=dict)
    chunks: list[Chunk] = field(default_factory=list)

    @property
    def messages(self) -> int:
        """Number of messages in the bag."""
        return sum(chunk.messages for chunk in self.chunks)

    def count(self, number: int) -> int:
        """Return the number of messages of a connection."""
        return sum(chunk.counts.get(number, 0) for chunk in self.chunks)

    @property
    def start(self) -> int | None:
        """Time of the first message [ns]; None if there are no messages."""
        return min((chunk.start for chunk in self.chunks if chunk.counts), default=None)

    @property
    def end(self) -> int | None:
        """Time of the last message [ns]; None if there are no messages."""
        return max((chunk.end for chunk in self.chunks if chunk.counts), default=None)
