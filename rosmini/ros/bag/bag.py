"""A bag as an object, with the interface of ROS's ``rosbag.Bag`` (http://wiki.ros.org/rosbag/Code%20API).

>>> import io
>>> from rosmini.ros.bag import Bag
>>> from rosmini.msgs.std_msgs.msg import String
>>> from rosmini.core.time import Time
>>> file = io.BytesIO()
>>> with Bag(file, "w") as bag:
...     bag.write("/chatter", String("hello"), Time(3))
>>> for topic, message, t in Bag(file):
...     print(topic, message.data, t.to_sec())
/chatter hello 3.0
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Mapping
from io import BytesIO, FileIO, IOBase, TextIOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, Self

from rosmini.core.errors import DeserializationError, nearest, shown
from rosmini.core.files import check
from rosmini.core.names import canonicalize
from rosmini.core.time import Time

from .errors import NotOpenForWriting, ROSBagException, ROSBagUnindexedException, in_file
from .index import Connection, Index, connection
from .info import info_text, info_yaml
from .reader import Input, RawMessage, Reader, index_position, read_index
from .records import Compression, check_compression, check_magic, check_threshold
from .scan import Scan, scan
from .summary import (
    BagMessage,
    BagMessageWithConnectionHeader,
    CompressionTuple,
    TopicTuple,
    TypesAndTopicsTuple,
    frequency,
    seconds,
)
from .types import Types, serialized
from .writer import CHUNK_THRESHOLD, Writer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from types import TracebackType

    from rosmini.core.time import TVal

    from .summary import ConnectionFilter


class Bag:
    """A bag, open for reading ("r"), writing ("w": it starts empty) or appending ("a").

    Args:
        f: the file's path, or a file open in binary mode.
        mode: "r", "w" or "a". Messages can be read in all of them.
        compression: of the chunks that are written: "none", "bz2" or "lz4" (`Compression`).
        chunk_threshold: size at which a chunk is closed [bytes].
        allow_unindexed: read an unfinished bag as far as possible; in mode "a", repair it.
        options: {"compression": ..., "chunk_threshold": ...}, like the two arguments.
        skip_index: accepted for compatibility with ROS; an index is always read only when it is needed.
        numpy: return numeric arrays as read-only numpy arrays, otherwise as tuples and bytes like rospy.

    Raises:
        ROSBagException: the file is empty, damaged, encrypted or not a bag; `ROSBagUnindexedException` if it has no
            index, or a damaged one.
        OSError: the file cannot be opened.
        ValueError: ``f`` is neither a path nor a stream, or the mode, compression or threshold is not valid.

    As in ROS, all methods that need the file raise ``ValueError`` once the bag is closed.

    """

    def __init__(
        self,
        f: str | os.PathLike[str] | BinaryIO,
        mode: str = "r",
        compression: str = Compression.NONE,
        chunk_threshold: int = CHUNK_THRESHOLD,
        allow_unindexed: bool = False,
        options: Mapping[str, Any] | None = None,
        skip_index: bool = False,  # noqa: ARG002 - rosbag's signature
        *,
        numpy: bool = True,
    ) -> None:
        if not f:
            raise ValueError("filename (or stream) is invalid")
        if mode not in ("r", "w", "a"):
            raise ValueError(f'mode "{mode}" is invalid: use "r", "w" or "a"')
        if options is not None and not isinstance(options, Mapping):
            raise ValueError(f"options are a dict, not {shown(options)}")
        given = options or {}
        self._compression = check_compression(given.get("compression", compression))
        self._chunk_threshold = check_threshold(given.get("chunk_threshold", chunk_threshold))
        if isinstance(f, TextIOBase):
            raise ROSBagException("In Python 3 the bag file must be opened in binary mode")
        self._mode = mode
        self._numpy = numpy
        self._filename = None if isinstance(f, IOBase) else os.fspath(f)  # type: ignore[arg-type]
        self._file: BinaryIO | None = None
        self._input: BinaryIO | None = None
        self._writer: Writer | None = None
        self._types = Types(self._name)
        self._version = 200
        self._numbers: dict[tuple[str, bytes], int] = {}
        self._by_topic: dict[str, int] = {}
        self.problems: list[str] = []
        """Problems of a bag that was opened without an index."""
        try:
            with in_file(self._name):
                self._index = self._open(f, allow_unindexed)
        except BaseException:
            self._close_files()
            raise

    def __repr__(self) -> str:
        state = {"r": "reading", "w": "writing", "a": "appending"}[self._mode]
        return f"<Bag {self._name}, {'closed' if self._file is None else f'open for {state}'}>"

    @property
    def _name(self) -> str:
        return self._filename or "the bag"

    # -- opening and closing -----------------------------------------------------------------------------------------

    def _open(self, f: Any, allow_unindexed: bool) -> Index:
        stream = self._filename is None
        if self._mode == "a" and not stream and not Path(f).exists():
            self._mode = "w"
        if self._mode == "r":
            if not (stream or Path(f).is_dir()):
                check(f, sys.maxsize)  # opening a pipe would wait for its writer
            self._file = self._input = f if stream else Input(FileIO(f))
            return self._read_index(self._file, allow_unindexed)
        # no buffer: data that a full disk refuses must not wait in one
        self._file = f if stream else FileIO(f, "w+" if self._mode == "w" else "r+")
        self._input = f if stream else Input(FileIO(f))
        if self._mode == "w":
            self._writer = self._new_writer(self._file)
        else:
            self._append(self._file, self._input, allow_unindexed)
        assert self._writer is not None  # noqa: S101 - both ways have set it
        return self._writer.index

    def _new_writer(self, file: BinaryIO, index: Index | None = None, position: int | None = None) -> Writer:
        return Writer(
            file,
            self._name,
            compression=self._compression,
            chunk_threshold=self._chunk_threshold,
            index=index,
            position=position,
        )

    def _read_index(self, file: BinaryIO, allow_unindexed: bool) -> Index:
        self._version = check_magic(file, self._name)
        try:
            return read_index(file, self._name)
        except ROSBagUnindexedException:
            if not allow_unindexed:
                raise
        found = scan(file, self._name)
        self.problems = found.problems
        if not found.tail and found.bare is None:
            return found.index
        # whole messages of an unfinished chunk are read from a copy in memory; the file is not changed
        copy = BytesIO()
        file.seek(0)
        copy.write(file.read(found.end))
        self._resume(copy, found).close()
        if self._filename is not None:
            file.close()
        self._file = self._input = copy
        return read_index(copy, self._name)

    def _append(self, file: BinaryIO, source: BinaryIO, allow_unindexed: bool) -> None:
        version = check_magic(source, self._name)
        if version != self._version:
            raise ROSBagException(
                f"bag version {version} is unsupported for appending: write the messages of {self._name} to a new bag"
            )
        try:
            index = read_index(source, self._name)
        except ROSBagUnindexedException:
            if not allow_unindexed:
                raise
            found = scan(source, self._name)
            self.problems = found.problems
            self._writer = self._resume(file, found)
        else:
            end = index_position(source)
            file.truncate(end)
            self._writer = self._new_writer(file, index, end)
        for number, known in self._writer.index.connections.items():
            self._numbers[known.topic, known.raw] = number
            self._by_topic.setdefault(known.topic, number)

    def _resume(self, file: BinaryIO, found: Scan) -> Writer:
        """Return a writer that continues after the last chunk found, with the messages of the unfinished chunk."""
        file.truncate(found.end)
        writer = self._new_writer(file, found.index, found.end)
        if found.bare is not None:
            writer.write_index_data(found.bare)
        for known in found.index.chunks:
            known.entries = None  # they are in the file now
        for known_connection, time, data in found.tail:
            writer.write(known_connection.id, time, data)
        return writer

    def reindex(self) -> Iterator[int]:
        """Rebuild the index of a bag opened with mode "a" and ``allow_unindexed``; yield positions in the file.

        Opening the bag has already done this; the method exists for programs that call it, as ROS's tool does.
        """
        yield from (chunk.position for chunk in self._index.chunks)

    def flush(self) -> None:
        """Write everything that is not in the file yet, except the index."""
        self._reading()
        if self._writer is not None:
            self._writer.flush()

    def close(self) -> None:
        """Write the index and close the file; may be called repeatedly. Raises ``BagFull`` if there is no room."""
        try:
            if self._writer is not None and self._file is not None:
                self._writer.close()
        finally:
            self._close_files()

    def _close_files(self) -> None:
        if self._filename is not None:
            for file in (self._file, self._input):
                if file is not None:
                    file.close()
        self._file = self._input = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # -- what it is --------------------------------------------------------------------------------------------------

    @property
    def filename(self) -> str | None:
        """The file's path; None if the bag was made from an open file."""
        return self._filename

    @property
    def version(self) -> int:
        """Version of the format: 200 for 2.0."""
        return self._version

    @property
    def mode(self) -> str:
        """Mode in which the bag was opened."""
        return self._mode

    @property
    def options(self) -> dict[str, Any]:
        """Options for writing."""
        return {"compression": self._compression, "chunk_threshold": self._chunk_threshold}

    @property
    def size(self) -> int:
        """Length of the file [bytes]; while writing, including the data still in memory."""
        file = self._reading()
        if self._writer is not None and not self._writer.closed:
            return self._writer.size
        if self._filename is not None:
            return Path(self._filename).stat().st_size
        file.seek(0, os.SEEK_END)
        return file.tell()

    @property
    def compression(self) -> str:
        """Compression of the chunks written from now on."""
        return self._compression

    @compression.setter
    def compression(self, compression: str) -> None:
        check_compression(compression)
        self.flush()
        self._compression = compression
        if self._writer is not None:
            self._writer.compression = compression

    @property
    def chunk_threshold(self) -> int:
        """Size at which a chunk is closed [bytes]."""
        return self._chunk_threshold

    @chunk_threshold.setter
    def chunk_threshold(self, chunk_threshold: int) -> None:
        check_threshold(chunk_threshold)
        self.flush()
        self._chunk_threshold = chunk_threshold
        if self._writer is not None:
            self._writer.chunk_threshold = chunk_threshold

    @property
    def index(self) -> Index:
        """The connections and chunks; also available once the bag is closed."""
        if self._writer is not None and self._file is not None:
            self._writer.flush()
        return self._index

    # -- reading -----------------------------------------------------------------------------------------------------

    def _reading(self) -> BinaryIO:
        if self._input is None:
            raise ValueError(f"I/O operation on a closed bag: {self._name}")
        return self._input

    def reader(self) -> Reader:
        """Return the reader of the bag; it also sees everything written so far."""
        self.flush()
        return Reader(self._reading(), self._index, self._name)

    def read_raw(
        self,
        topics: str | Iterable[str] | None = None,
        start_time: TVal | None = None,
        end_time: TVal | None = None,
        connection_filter: ConnectionFilter | None = None,
    ) -> Iterator[RawMessage]:
        """Yield messages as bytes, with their connections; the arguments are those of :meth:`read_messages`."""
        wanted = {found.id for found in self.connections(topics, connection_filter)}
        start, end = (None if time is None else time.to_nsec() for time in (start_time, end_time))
        return self.reader().messages(wanted, start, end)

    def read_messages(
        self,
        topics: str | Iterable[str] | None = None,
        start_time: TVal | None = None,
        end_time: TVal | None = None,
        connection_filter: ConnectionFilter | None = None,
        raw: bool = False,
        return_connection_header: bool = False,
    ) -> Iterator[Any]:
        """Yield (topic, message, time) of one, several or all topics, in time order, between two times (both included).

        With ``raw`` a message is (type, bytes, md5 sum, (chunk, offset), class). Raises ``ROSBagException`` on damage.
        """
        found = self.read_raw(topics, start_time, end_time, connection_filter)
        return self._messages(found, raw, return_connection_header)

    def _messages(self, found: Iterator[RawMessage], raw: bool, with_header: bool) -> Iterator[Any]:
        decoders: dict[int, Callable[[bytes], Any]] = {}
        for stored in found:
            conn, nanoseconds, data, chunk, offset = stored
            if raw:
                position = (self._index.chunks[chunk].position, offset)
                message: Any = (conn.type, data, conn.md5sum, position, self._types.of(conn))
            else:
                decode = decoders.get(conn.id)
                if decode is None:
                    decode = decoders[conn.id] = self._decoder(conn)
                try:
                    message = decode(data)
                except DeserializationError as error:
                    raise self._unreadable(stored, error) from error
            del stored, data  # free its memory for the next one, which saves much time with large messages
            time = Time(*divmod(nanoseconds, 1_000_000_000))
            if with_header:
                yield BagMessageWithConnectionHeader(conn.topic, message, time, dict(conn.header))
            else:
                yield BagMessage(conn.topic, message, time)

    def decode(self, stored: RawMessage) -> Any:
        """Return the frozen message of `read_raw`'s result; raises ``DeserializationError`` with the file and place."""
        try:
            return self.message_class(stored.connection)._decode(stored.data)
        except DeserializationError as error:
            raise self._unreadable(stored, error) from error

    def _unreadable(self, stored: RawMessage, error: DeserializationError) -> DeserializationError:
        place = f"byte {stored.offset} of the chunk at byte {self._index.chunks[stored.chunk].position}"
        return DeserializationError(
            f"{self._name}: the message on {stored.connection.topic} at {place} cannot be read: {error}"
        )

    def _decoder(self, conn: Connection) -> Callable[[bytes], Any]:
        cls = self._types.of(conn)
        decode = cls._decode
        thaw = cls._thawer(numpy=self._numpy)
        return decode if thaw is None else lambda data: thaw(decode(data))

    def __iter__(self) -> Iterator[Any]:
        return self.read_messages()

    def connections(
        self, topics: str | Iterable[str] | None = None, connection_filter: ConnectionFilter | None = None
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
                or connection_filter(found.topic, found.type, found.md5sum, found.definition, dict(found.header))
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
        return seconds(self.index.start)

    def get_end_time(self) -> float:
        """Return the time of the last message [s]. Raises ``ROSBagException`` for an empty bag."""
        return seconds(self.index.end)

    def get_compression_info(self) -> CompressionTuple:
        """Return the compression of most chunks, and the number of bytes without and with it."""
        chunks = self.index.chunks
        ranked = sorted(
            ((count, name) for name, count in Counter(chunk.compression for chunk in chunks).items()), reverse=True
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
        for each in self.index.connections.values():
            found.setdefault(each.type, each.md5sum)
        return dict(sorted(found.items()))

    def topics(self, topic_filters: str | list[str] | None = None, *, freq: bool = True) -> dict[str, TopicTuple]:
        """Return the summaries of one, several or all topics by name; frequencies require reading all index data."""
        reader = self.reader()
        topics = {}
        for topic in sorted({found.topic for found in self.connections(topic_filters)}):
            here = self.connections(topic)
            count = sum(self.index.count(found.id) for found in here)
            topics[topic] = TopicTuple(here[0].type, count, len(here), frequency(reader, here) if freq else None)
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

    def __str__(self) -> str:
        return info_text(self)

    def _get_yaml_info(self) -> str:
        return info_yaml(self)

    # -- writing -----------------------------------------------------------------------------------------------------

    def write(
        self,
        topic: str,
        msg: Any,
        t: TVal | None = None,
        raw: bool = False,
        connection_header: Mapping[str, str | bytes] | None = None,
    ) -> None:
        """Write a message, recorded at ``t`` (default: the graph's time now).

        With ``raw`` a message is (type, bytes, md5 sum, class), or the same with a position before the class. Messages
        with another ``connection_header`` get a separate connection. Raises ``ValueError`` for a closed bag, an
        empty topic or no message, ``BagFull`` when there is no more room, ``SerializationError`` for a field of the
        wrong type.
        """
        if self._file is None:
            raise ValueError(f"I/O operation on a closed bag: {self._name}")
        writer = self._writer
        if not topic:
            raise ValueError("topic is invalid: it is empty")
        if writer is None:
            raise NotOpenForWriting(f'{self._name} is open for reading: open it with mode "w" or "a" to write')
        if msg is None or (raw and len(msg) not in (4, 5)):
            raise ValueError("msg is invalid: a message, or with raw=True (type, bytes, md5sum, class)")
        data: bytes
        if raw:
            kind, data, md5sum, cls = msg[0], msg[1], msg[2], msg[-1]
        else:
            kind, data, md5sum, cls = msg._type, serialized(msg), msg._md5sum, type(msg)
        time = _now() if t is None else t
        number = self._by_topic.get(topic) if connection_header is None else None
        if number is None or writer.index.connections[number].md5sum != md5sum:
            number = self._connect(topic, kind, md5sum, cls, connection_header)
        writer.write(number, time.to_nsec(), data)

    def _connect(self, topic: str, kind: str, md5sum: str, cls: Any, header: Mapping[str, str | bytes] | None) -> int:
        if header is None:
            if cls is None:
                raise ROSBagException(f"{kind} on {topic}: give its class, or a connection header")
            header = {"topic": topic, "type": kind, "md5sum": md5sum, "message_definition": cls._full_text}
        return self.connect(connection(0, topic, header))

    def connect(self, conn: Connection) -> int:
        """Return this bag's number for a connection of another bag or of a graph; its header is kept byte for byte."""
        if self._writer is None:
            raise NotOpenForWriting(f"{self._name} is not open for writing")
        key = conn.topic, conn.raw
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = self._writer.add(conn).id
            self._by_topic.setdefault(conn.topic, number)
        return number

    def write_raw(self, number: int, nanoseconds: int, data: bytes) -> None:
        """Write a message, recorded at a time [ns], to the connection whose number :meth:`connect` returned."""
        if self._writer is None or self._file is None:
            raise NotOpenForWriting(f"{self._name} is not open for writing")
        self._writer.write(number, nanoseconds, data)

    def sync(self) -> None:
        """Write the data in memory so that it survives a crash, and continue with the open chunk."""
        if self._writer is not None:
            self._writer.sync()


def _now() -> Time:
    from rosmini.core.graph import running_graph  # a program that only reads a bag needs no graph

    return running_graph().now()
