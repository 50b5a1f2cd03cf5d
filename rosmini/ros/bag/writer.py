"""Writing a bag: messages are collected in chunks, each followed by its index data; the index comes last.

A bag is always intact up to its last flush: after a power failure, ``rosbag reindex`` finds everything that was
flushed.
"""

from __future__ import annotations

import errno
import struct
from collections.abc import Iterable
from typing import BinaryIO

from .errors import BagFull, ROSBagException
from .index import Chunk, Connection, Index
from .records import (
    MAGIC,
    NSECS,
    OP_CHUNK,
    OP_CHUNK_INFO,
    OP_CONNECTION,
    OP_INDEX,
    OP_MESSAGE,
    Compression,
    bag_header,
    check_compression,
    compress,
    index_entry,
    pack_record,
    pack_time,
    record_start,
    u32,
    u64,
)

CHUNK_THRESHOLD = 768 * 1024
"""Size at which a chunk is closed [bytes]."""

LARGE = 64 * 1024
"""Minimum size of parts of a chunk that are written without joining [bytes]."""

Entry = tuple[int, int, bytes, bytes]
"""A record of an open chunk: connection (-1: it describes one), time [ns], and its bytes in two parts."""

FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})


class Writer:
    """Writes a bag at the end of an open file.

    Args:
        file: open for reading and writing; the caller closes it.
        name: name of the file in messages.
        index: contents of the bag before ``position``; omitted for a new bag.
        position: where the writer continues.

    """

    def __init__(
        self,
        file: BinaryIO,
        name: str,
        *,
        compression: str = Compression.NONE,
        chunk_threshold: int = CHUNK_THRESHOLD,
        index: Index | None = None,
        position: int | None = None,
    ) -> None:
        self._file = file
        self._name = name
        self.compression = check_compression(compression)
        self.chunk_threshold = chunk_threshold
        self.index = Index() if index is None else index
        self.closed = False
        self._prefixes: dict[int, bytes] = {}
        self._records: list[Entry] = []
        """Records of the open chunk."""
        self._size = 0
        self._end = 0
        self._described = set(self.index.connections)
        if position is None:
            self._put(0, MAGIC + bag_header(0, 0, 0))
            position = self._end
        else:
            self._put(len(MAGIC), bag_header(0, 0, 0))  # until it is closed, this bag has no index
        self._position = position

    # -- messages --------------------------------------------------------------------------------------------------

    def add(self, connection: Connection) -> Connection:
        """Add a connection, which gets the next number of this bag; return it with that number."""
        number = len(self.index.connections)
        while number in self.index.connections:
            number += 1
        mine = Connection(number, connection.topic, connection.raw, connection.place)
        self.index.connections[number] = mine
        return mine

    def write(self, number: int, nanoseconds: int, data: bytes) -> None:
        """Write a message of the connection ``number``, recorded at a time [ns].

        Raises ``BagFull`` when there is no more room; the bag is then closed, and has no index.
        """
        if self.closed:
            raise ROSBagException(f"{self._name} is closed: no message can be written to it any more")
        prefix = self._prefixes.get(number)
        if prefix is None:
            prefix = self._begin(number)
        secs, nsecs = divmod(nanoseconds, NSECS)
        try:
            head = prefix + index_entry.pack(secs, nsecs, len(data))
        except struct.error as error:
            raise ROSBagException(
                f"{self._name} cannot hold a message of {len(data):,} bytes at {secs} s: times go from 0 to "
                f"{2**32 - 1} s"
            ) from error
        self._records.append((number, nanoseconds, head, data))
        self._size += len(head) + len(data)
        if self._size >= self.chunk_threshold:
            self.flush()

    def _begin(self, number: int) -> bytes:
        """Write a connection's record before its first message; return the start of its message records."""
        if number not in self._described:
            record = self._connection_record(self.index.connections[number])
            self._records.append((-1, 0, record, b""))
            self._size += len(record)
            self._described.add(number)
        whole = pack_record({"op": bytes([OP_MESSAGE]), "conn": u32.pack(number), "time": b"\0" * 8})
        prefix = self._prefixes[number] = whole[:-12]  # without the time and length of the data
        return prefix

    @property
    def size(self) -> int:
        """Future length of the file, without the index and before compression [bytes]."""
        return self._position + self._size

    # -- chunks ----------------------------------------------------------------------------------------------------

    def flush(self) -> Chunk | None:
        """Write the open chunk and return it. Raises ``BagFull`` as :meth:`write` does."""
        chunk = self.sync()
        if chunk is not None:
            self._records, self._size = [], 0
            self._position = self._end
            self.index.chunks.append(chunk)
        return chunk

    def sync(self) -> Chunk | None:
        """Write the open chunk, so that its messages survive a crash; it stays open and will be written again."""
        if not self._records:
            return None
        try:
            return self._write_chunk(self._records)
        except OSError as error:
            if error.errno not in FULL:
                raise
            raise self._full(error) from error

    def _write_chunk(self, records: list[Entry]) -> Chunk:
        parts = _gathered(part for _, _, *both in records for part in both)
        size = length = sum(map(len, parts))
        if self.compression != Compression.NONE:
            parts = [compress(b"".join(parts), self.compression)]
            length = len(parts[0])
        fields = {"compression": self.compression.encode(), "op": bytes([OP_CHUNK]), "size": u32.pack(size)}
        start = record_start(fields, length)
        chunk = Chunk(self._position, self._position + len(start), self.compression, length, size)
        entries = _fill(chunk, records)
        self._put(self._position, start, *parts, *index_records(chunk, entries))
        return chunk

    def _put(self, position: int, *parts: bytes) -> None:
        """Write all parts in sequence from a position; an unbuffered file may accept less at a time."""
        self._file.seek(position)
        for part in parts:
            rest = memoryview(part)
            while rest:
                rest = rest[self._file.write(rest) :]
        self._end = position + sum(map(len, parts))

    def write_index_data(self, chunk: Chunk) -> None:
        """Write the missing index data of the chunk at the end of the file."""
        self._put(self._position, b"".join(index_records(chunk, chunk.entries or {})))
        self._position = self._end

    def _full(self, error: OSError) -> BagFull:
        """Close the bag, which stays without an index, and return the error."""
        self.closed = True
        return BagFull(
            f"{self._name} cannot grow any more ({error.strerror}), and is closed. Make room, then "
            f"`rosbag reindex {self._name}` saves what it holds; --lz4 or --bz2 needs less room."
        )

    # -- the end ---------------------------------------------------------------------------------------------------

    def close(self) -> None:
        """Write the open chunk and the index; may be called repeatedly. Raises ``BagFull`` as :meth:`write` does."""
        if self.closed:
            return
        self.flush()
        try:
            self._write_end()
        except OSError as error:
            if error.errno not in FULL:
                raise
            raise self._full(error) from error
        self.closed = True

    def _write_end(self) -> None:
        """Write the index after the last chunk, then its position into the first record."""
        index = self.index
        parts = [self._connection_record(connection) for connection in index.connections.values()]
        parts += [_chunk_info(chunk) for chunk in index.chunks]
        self._put(self._position, b"".join(parts))
        self._file.truncate(self._end)
        self._put(len(MAGIC), bag_header(self._position, len(index.connections), len(index.chunks)))

    @staticmethod
    def _connection_record(connection: Connection) -> bytes:
        fields = {"conn": u32.pack(connection.id), "op": bytes([OP_CONNECTION]), "topic": connection.topic.encode()}
        return pack_record(fields, connection.raw)


def _gathered(parts: Iterable[bytes]) -> list[bytes]:
    """Return the same bytes in fewer parts: small parts are joined; copying large ones costs more than a write."""
    gathered: list[bytes] = []
    small: list[bytes] = []
    for part in parts:
        if len(part) < LARGE:
            small.append(part)
        else:
            gathered += b"".join(small), part
            small = []
    return [*gathered, b"".join(small)]


def _fill(chunk: Chunk, records: Iterable[Entry]) -> dict[int, bytes]:
    """Record times and counts of a chunk's records, and return their packed entries."""
    entries: dict[int, list[tuple[int, int]]] = {}
    packed: dict[int, bytes] = {}
    offset = 0
    for number, nanoseconds, head, data in records:
        if number >= 0:
            entries.setdefault(number, []).append((nanoseconds, offset))
        offset += len(head) + len(data)
    for number, pairs in entries.items():
        pairs.sort()
        packed[number] = b"".join(
            index_entry.pack(*divmod(nanoseconds, NSECS), offset) for nanoseconds, offset in pairs
        )
        chunk.counts[number] = len(pairs)
    if entries:
        chunk.start = min(pairs[0][0] for pairs in entries.values())
        chunk.end = max(pairs[-1][0] for pairs in entries.values())
    return packed


def index_records(chunk: Chunk, entries: dict[int, bytes]) -> Iterable[bytes]:
    """Yield the index data of a chunk: a record for each connection with messages in it."""
    for number, packed in entries.items():
        fields = {
            "conn": u32.pack(number),
            "count": u32.pack(chunk.counts[number]),
            "op": bytes([OP_INDEX]),
            "ver": u32.pack(1),
        }
        yield pack_record(fields, packed)


def _chunk_info(chunk: Chunk) -> bytes:
    fields = {
        "chunk_pos": u64.pack(chunk.position),
        "count": u32.pack(len(chunk.counts)),
        "end_time": pack_time(chunk.end),
        "op": bytes([OP_CHUNK_INFO]),
        "start_time": pack_time(chunk.start),
        "ver": u32.pack(1),
    }
    counts = b"".join(u32.pack(number) + u32.pack(count) for number, count in chunk.counts.items())
    return pack_record(fields, counts)
