"""Reading a bag: first its index, then its messages in time order, chunk by chunk."""

from __future__ import annotations

import struct
from bisect import bisect_left
from collections import OrderedDict
from collections.abc import Collection, Iterator
from io import BufferedReader
from typing import BinaryIO, NamedTuple

from .errors import DamagedIndex, ROSBagFormatException, ROSBagUnindexedException, in_file
from .index import Chunk, Connection, Index
from .records import (
    LATEST,
    MAGIC,
    MESSAGE_MARK,
    NSECS,
    OP_BAG_HEADER,
    OP_CHUNK,
    OP_CHUNK_INFO,
    OP_CONNECTION,
    OP_INDEX,
    OP_MESSAGE,
    Allowance,
    Compression,
    Record,
    Truncated,
    check_magic,
    decompress,
    encryption,
    field,
    index_entry,
    read_exactly,
    read_record,
    stamp,
    time_field,
    u32,
    u64,
)

KEPT = 16 * 1024 * 1024
"""Maximum size of cached chunks [bytes], besides the last one; overlapping chunks are read alternately."""


LARGE = 64 * 1024
"""Mean message length from which messages of an uncompressed chunk are read one by one [bytes]."""


MAX_SKIPPED = 100
"""Maximum number of connection records before the message that an index entry names."""


class Input(BufferedReader):
    """A file reader that closes itself silently when garbage-collected."""

    def __del__(self) -> None:
        self.close()


class RawMessage(NamedTuple):
    """A message as stored in the bag; ``time`` is when it was recorded [ns]."""

    connection: Connection
    time: int
    data: bytes
    chunk: int
    offset: int


def read_data(file: BinaryIO, record: Record, what: str) -> bytes:
    """Read a record's data. Raises ``Truncated`` if the file ends in it."""
    file.seek(record.data_position)
    return read_exactly(file, record.data_length, what)


def read_index(file: BinaryIO, name: str) -> Index:
    """Read the index at the end of a bag.

    Raises ``ROSBagUnindexedException`` if it has none or a damaged one, ``ROSBagFormatException`` if the file is not a
    bag, ``ROSBagEncryptNotSupportedException`` if it is encrypted.
    """
    check_magic(file, name)
    try:
        return _index(file, name)
    except Truncated as error:
        raise ROSBagUnindexedException(
            f"{name} is truncated: {error.value} Its index is lost with its end: `rosbag reindex {name}` makes a new "
            "one."
        ) from error
    except ROSBagFormatException as error:  # like rosbag, treat a damaged index as a missing one
        raise DamagedIndex(
            f"{name} has no index that can be read: {error.value}. `rosbag reindex {name}` saves what is in it."
        ) from error


def _index(file: BinaryIO, name: str) -> Index:
    first = read_record(file, len(MAGIC))
    if first is None:
        raise ROSBagUnindexedException(f"{name} ends after its first line: nothing was recorded, or it is truncated")
    if first.op != OP_BAG_HEADER:
        raise ROSBagFormatException("there is no bag header after its first line")
    encryption(first, name)
    position = field(first, "index_pos", u64)
    if position == 0:
        raise ROSBagUnindexedException(
            f"{name} has no index: its recording did not come to an end. `rosbag reindex {name}` makes one."
        )
    index = Index()
    for _ in range(field(first, "conn_count", u32)):
        record = _expected(file, position, OP_CONNECTION)
        found = connection_of(file, record, name)
        index.connections[found.id] = found
        position = record.end
    for _ in range(field(first, "chunk_count", u32)):
        record = _expected(file, position, OP_CHUNK_INFO)
        index.chunks.append(_chunk_of(file, record))
        position = record.end
    _check_apart(index.chunks)
    allowance = Allowance()
    for chunk in index.chunks:
        allowance.charge(chunk.size, chunk.compressed)
    return index


def _check_apart(chunks: list[Chunk]) -> None:
    """Raise ``ROSBagFormatException`` if two chunks overlap in the file and would be read twice."""
    end = 0
    for chunk in sorted(chunks, key=lambda each: each.position):
        if chunk.position < end:
            raise ROSBagFormatException(f"two chunk infos name the same bytes at {chunk.position}: the file is damaged")
        end = chunk.data_position + chunk.compressed


def index_position(file: BinaryIO) -> int:
    """Return the position of a bag's index, where an appending writer continues."""
    first = read_record(file, len(MAGIC))
    return 0 if first is None else field(first, "index_pos", u64)


def _expected(file: BinaryIO, position: int, op: int) -> Record:
    record = read_record(file, position)
    if record is None:
        raise Truncated("the file ends within its index.")
    if record.op != op:
        raise ROSBagFormatException(
            f"the index has a record of kind {record.op} at byte {position} where kind {op} belongs: the file is "
            "damaged"
        )
    return record


def connection_of(file: BinaryIO, record: Record, name: str) -> Connection:
    """Return the connection that a record of the file describes."""
    raw = read_data(file, record, "a connection")
    topic = record.fields.get("topic", b"").decode("utf-8", "replace")
    return Connection(field(record, "conn", u32), topic, raw, f"{name}: the connection at byte {record.position}")


def chunk_at(file: BinaryIO, position: int) -> Chunk:
    """Return a chunk as its header describes it; times and counts come from the index."""
    record = read_record(file, position)
    if record is None:
        raise Truncated(f"the file ends before the chunk at byte {position}.")
    if record.op != OP_CHUNK:
        raise ROSBagFormatException(
            f"the index names a chunk at byte {position}, and there is none: the file is damaged"
        )
    compression = record.fields.get("compression", b"").decode("utf-8", "replace")
    return Chunk(position, record.data_position, compression, record.data_length, field(record, "size", u32))


def _chunk_of(file: BinaryIO, record: Record) -> Chunk:
    if field(record, "ver", u32) != 1:
        raise ROSBagFormatException(f"unknown version of the chunk info at byte {record.position}")
    counts = read_data(file, record, "the index")
    if len(counts) != 8 * field(record, "count", u32):
        raise ROSBagFormatException(
            f"the chunk info at byte {record.position} is not as long as it says: the file is damaged"
        )
    chunk = chunk_at(file, field(record, "chunk_pos", u64))
    chunk.start, chunk.end = time_field(record, "start_time"), time_field(record, "end_time")
    chunk.counts = dict(stamp.iter_unpack(counts))
    return chunk


class Reader:
    """Reads the messages of an open bag whose index is known.

    It caches few chunks, so memory does not grow with the bag. The index may grow while it reads.
    """

    def __init__(self, file: BinaryIO, index: Index, name: str) -> None:
        self._file = file
        self._name = name
        self.index = index
        self._chunks: OrderedDict[int, bytes] = OrderedDict()

    def messages(
        self, wanted: Collection[int] | None = None, start: int | None = None, end: int | None = None
    ) -> Iterator[RawMessage]:
        """Yield the messages of ``wanted`` connections from ``start`` to ``end`` [ns], both included, in time order.

        Messages with the same time come in the order in which they were recorded. Raises ``ROSBagFormatException`` on
        damage.
        """
        if wanted is None:
            wanted = self.index.connections.keys()
        pending: list[tuple[int, int, int, int]] = []
        read: dict[int, int] = {}
        numbered = sorted(enumerate(self.index.chunks), key=lambda pair: pair[1].start)
        for number, chunk in numbered:
            if (end is not None and chunk.start > end) or (start is not None and chunk.end < start):
                continue
            ready = bisect_left(pending, (chunk.start,))
            yield from self._read(pending[:ready], read)
            pending = pending[ready:]
            pending += self._entries(number, chunk, wanted, start, end)
            pending.sort()
            if pending and pending[-1][0] > LATEST:
                raise ROSBagFormatException(
                    f"{self._name}: a message in the chunk at byte {chunk.position} has no time that ROS can write: "
                    "the file is damaged"
                )
        yield from self._read(pending, read)

    def times(self, number: int) -> list[int]:
        """Return the times of a connection's messages [ns], in order, without reading the messages."""
        found: list[int] = []
        for chunk in self.index.chunks:
            packed = self.entries(chunk).get(number, b"")
            found += [secs * NSECS + nsecs for secs, nsecs, _ in index_entry.iter_unpack(packed)]
        return sorted(found)

    def _entries(
        self, number: int, chunk: Chunk, wanted: Collection[int], start: int | None, end: int | None
    ) -> Iterator[tuple[int, int, int, int]]:
        for conn, packed in self.entries(chunk).items():
            if conn not in wanted:
                continue
            for secs, nsecs, offset in index_entry.iter_unpack(packed):
                time = secs * NSECS + nsecs
                if (start is None or time >= start) and (end is None or time <= end):
                    yield time, number, offset, conn

    def entries(self, chunk: Chunk) -> dict[int, bytes]:
        """Return the packed entries (see `Chunk`) of each connection in a chunk, from the index records after it."""
        if chunk.entries is not None:
            return chunk.entries
        entries: dict[int, bytes] = {}
        position = chunk.data_position + chunk.compressed
        with in_file(self._name):
            for _ in chunk.counts:
                record = _expected(self._file, position, OP_INDEX)
                if field(record, "ver", u32) != 1 or record.data_length % index_entry.size:
                    raise ROSBagFormatException(f"the index data at byte {position} is of an unknown form")
                entries[field(record, "conn", u32)] = read_data(self._file, record, "the index of a chunk")
                position = record.end
        return entries

    def data(self, chunk: Chunk) -> bytes:
        """Return a chunk's data, decompressed."""
        data = self._chunks.get(chunk.position)
        if data is None:
            while self._chunks and chunk.size + sum(map(len, self._chunks.values())) > KEPT:
                self._chunks.popitem(last=False)
            self._file.seek(chunk.data_position)
            with in_file(self._name):
                packed = read_exactly(self._file, chunk.compressed, f"the chunk at byte {chunk.position}")
                data = decompress(packed, chunk.compression, chunk.size, chunk.position)
            self._chunks[chunk.position] = data
        else:
            self._chunks.move_to_end(chunk.position)
        return data

    def _read(self, entries: list[tuple[int, int, int, int]], read: dict[int, int]) -> Iterator[RawMessage]:
        """Yield the messages of index entries; ``read`` counts the bytes read from each chunk."""
        connections, chunks = self.index.connections, self.index.chunks
        last, data, large = -1, b"", False
        with in_file(self._name):
            for time, number, offset, conn in entries:
                chunk = chunks[number]
                if number != last:
                    last = number
                    large = chunk.compression == Compression.NONE and chunk.size > LARGE * sum(chunk.counts.values())
                    data = b""  # so that two chunks are never in memory at once
                    data = data if large else self.data(chunk)
                # The message gets no name, so that its memory is free again for the next one.
                yield RawMessage(
                    connections[conn],
                    time,
                    _counted(
                        self._large_message(chunk, offset) if large else message_at(data, offset, chunk),
                        chunk,
                        number,
                        read,
                    ),
                    number,
                    offset,
                )

    def _large_message(self, chunk: Chunk, offset: int) -> bytes:
        """Return a message of an uncompressed chunk without reading the rest of the chunk; see `message_at`."""
        position, end = chunk.data_position + offset, chunk.data_position + chunk.size
        while (record := read_record(self._file, position)) is not None and record.end <= end:
            if record.op == OP_MESSAGE:
                return read_data(self._file, record, f"the message at byte {position}")
            position = record.end
        raise ROSBagFormatException(
            f"the chunk at byte {chunk.position} has no message at its byte {offset}: the file is damaged"
        )


def _counted(message: bytes, chunk: Chunk, number: int, read: dict[int, int]) -> bytes:
    """Return a message and count its bytes. Raises ``ROSBagFormatException`` if a chunk's messages overlap."""
    read[number] = read.get(number, 0) + len(message)
    if read[number] > chunk.size:
        raise ROSBagFormatException(f"the messages of the chunk at byte {chunk.position} overlap: the file is damaged")
    return message


def message_at(data: bytes, offset: int, chunk: Chunk) -> bytes:
    """Return the message whose record is at ``offset`` of a chunk's data, skipping connection records before it."""
    try:
        for _ in range(MAX_SKIPPED):
            begin = offset + 4
            end = begin + u32.unpack_from(data, offset)[0]
            length = u32.unpack_from(data, end)[0]
            if data.find(MESSAGE_MARK, begin, end) >= 0:
                break
            offset = end + 4 + length
        else:
            raise struct.error
    except struct.error as error:
        raise ROSBagFormatException(
            f"the chunk at byte {chunk.position} has no message at its byte {offset}: the file is damaged"
        ) from error
    message = data[end + 4 : end + 4 + length]
    if len(message) != length:
        raise ROSBagFormatException(
            f"the message at byte {offset} of the chunk at byte {chunk.position} is cut off: the file is damaged"
        )
    return message
