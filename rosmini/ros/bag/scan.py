"""Reading a bag without an index: record by record from the start, as far as possible."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import BinaryIO

from rosmini.core.errors import shown

from .errors import ROSBagException, ROSBagFormatException
from .index import Chunk, Connection, Index
from .reader import read_data
from .records import (
    COMPRESSIONS,
    MAGIC,
    NSECS,
    OP_BAG_HEADER,
    OP_CHUNK,
    OP_CONNECTION,
    OP_INDEX,
    OP_MESSAGE,
    PIECE,
    Allowance,
    Record,
    check_magic,
    decompress,
    encryption,
    index_entry,
    parse_fields,
    read_record,
    rescue,
    time_field,
    u32,
)
from .records import field as number_of

_CHUNK_MARK = b"\x04\x00\x00\x00op=" + bytes([OP_CHUNK])
_BEFORE_MARK = (4, *{8 + len(f"compression={name}") for name in COMPRESSIONS})
"""Number of bytes of a chunk's header before the mark: its length, or the compression too."""

MAX_RESCUED_BYTES = 64 * 1024 * 1024
"""Maximum data of truncated chunks kept in memory [bytes]; an aborted recording has one chunk of about a megabyte."""


@dataclass
class Scan:
    """Result of a scan: an index of all readable data, and the problems with the rest.

    A truncated chunk is not in the index; ``tail`` has its messages: (connection, time [ns], data).
    """

    name: str
    index: Index = field(default_factory=Index)
    tail: list[tuple[Connection, int, bytes]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    end: int = 0
    """End of the last whole chunk and its index data."""
    room: int = MAX_RESCUED_BYTES
    """Number of bytes of truncated chunks that may still be kept."""
    allowance: Allowance = field(default_factory=Allowance)
    bare: Chunk | None = None
    """The last whole chunk, if its index data is incomplete: then ``end`` is before that data."""


def scan(file: BinaryIO, name: str) -> Scan:
    """Read all records of a bag.

    Raises only if the file is not a bag, is encrypted, or is damaged from its first record on.
    """
    check_magic(file, name)
    found = Scan(name, end=len(MAGIC))
    position: int | None = found.end
    while position is not None:
        here = position
        try:
            record = read_record(file, position)
            if record is None:
                return found
            if record.op == OP_BAG_HEADER:
                encryption(record, name)
                found.end = position = record.end
            elif record.op != OP_CHUNK:  # the index, which is rebuilt
                position = record.end
            elif _is_open(file, record):
                _take_tail(file, record, found)
                return found
            else:
                chunk = _take_chunk(file, record, found)
                position, records = _after_index(file, record.end)
                if chunk is None or records == len(chunk.counts):
                    found.end = position
                    continue
                position = _next_chunk(file, position)
                if position is None:
                    found.end, found.bare = record.end, chunk
                    found.problems.append(f"the file ends behind the chunk at byte {record.position}")
                else:
                    # A reader needs the index data, so the messages are written again.
                    found.index.chunks.remove(chunk)
                    _rescue(read_data(file, record, "a chunk"), chunk.size, chunk.compression, found)
                    found.problems.append(f"no index data behind the chunk at byte {record.position}")
        except ROSBagFormatException as error:
            if here == len(MAGIC):
                raise  # continuing here would discard everything
            found.problems.append(str(error))
            position = _next_chunk(file, here + 1)
    return found


def _next_chunk(file: BinaryIO, position: int) -> int | None:
    """Return the position of the next whole chunk at or after ``position``, past damage; None if not found."""
    size = file.seek(0, 2)
    for start in range(position, size, PIECE):
        file.seek(start)
        piece = file.read(PIECE + len(_CHUNK_MARK) - 1)  # a mark may span two pieces
        at = -1
        while (at := piece.find(_CHUNK_MARK, at + 1)) >= 0:
            for before in _BEFORE_MARK:
                with suppress(ROSBagFormatException):
                    record = read_record(file, max(start + at - before, 0))
                    if record is None or record.op != OP_CHUNK or not record.data_length:
                        continue
                    if position <= record.position and record.end <= size:
                        return record.position
    return None


def _is_open(file: BinaryIO, record: Record) -> bool:
    """Return True if a chunk was never finished: its length is not filled in, or the file ends within it."""
    file.seek(0, 2)
    return record.end > file.tell() or record.data_length == 0


def _after_index(file: BinaryIO, position: int) -> tuple[int, int]:
    """Return the end of the index data after a chunk and its number of records, as far as it is whole."""
    file.seek(0, 2)
    size, records = file.tell(), 0
    while True:
        try:
            record = read_record(file, position)
        except ROSBagFormatException:
            return position, records
        if record is None or record.op != OP_INDEX or record.end > size:
            return position, records
        position, records = record.end, records + 1


def _take_chunk(file: BinaryIO, record: Record, found: Scan) -> Chunk | None:
    """Add a whole chunk and return it; None if it has no messages or is damaged."""
    compression = record.fields.get("compression", b"").decode("utf-8", "replace")
    chunk = Chunk(
        record.position, record.data_position, compression, record.data_length, number_of(record, "size", u32)
    )
    found.allowance.charge(chunk.size, chunk.compressed)
    packed = read_data(file, record, f"the chunk at byte {record.position}")
    try:
        data = decompress(packed, compression, chunk.size, record.position)
    except ROSBagException as error:
        found.problems.append(str(error))
        _rescue(packed, chunk.size, compression, found)
        return None
    entries: dict[int, list[tuple[int, int]]] = {}
    for offset, what, time, _ in _messages(data, found):
        entries.setdefault(what, []).append((time, offset))
    chunk.entries = {}
    for number, pairs in entries.items():
        chunk.entries[number] = b"".join(
            index_entry.pack(*divmod(time, NSECS), offset) for time, offset in sorted(pairs)
        )
        chunk.counts[number] = len(pairs)
    if not entries:
        return None
    chunk.start = min(time for pairs in entries.values() for time, _ in pairs)
    chunk.end = max(time for pairs in entries.values() for time, _ in pairs)
    found.index.chunks.append(chunk)
    return chunk


def _take_tail(file: BinaryIO, record: Record, found: Scan) -> None:
    """Take the recoverable messages of the chunk that was being written."""
    compression = record.fields.get("compression", b"").decode("utf-8", "replace")
    there = max(file.seek(0, 2) - record.data_position, 0)
    file.seek(record.data_position)
    _rescue(file.read(min(there, found.room)), number_of(record, "size", u32), compression, found)
    found.problems.append(
        f"the recording ended within the chunk at byte {record.position}: {len(found.tail)} messages of it were whole"
    )


def _rescue(packed: bytes, size: int, compression: str, found: Scan) -> None:
    """Take the messages of an incomplete chunk, as far as possible; ``size`` is 0 until a chunk is finished."""
    data = rescue(packed, compression, min(size or found.room, found.room))
    found.room -= len(data)
    found.tail += _tail_messages(data, found)


def _tail_messages(data: bytes, found: Scan) -> Iterator[tuple[Connection, int, bytes]]:
    for _, number, time, message in _messages(data, found):
        yield found.index.connections[number], time, message


def _messages(data: bytes, found: Scan) -> Iterator[tuple[int, int, int, bytes]]:
    """Yield (offset, connection, time [ns], message) from a chunk's data, up to where it is truncated.

    Adds the connections found.
    """
    index = found.index
    at, size = 0, len(data)
    while at + 4 <= size:
        begin = at + 4
        end = begin + u32.unpack_from(data, at)[0]
        if end + 4 > size:
            return
        length = u32.unpack_from(data, end)[0]
        if end + 4 + length > size:
            return
        try:
            fields = parse_fields(data[begin:end], "a record")
            record = Record(at, fields, end + 4, length)
            number = number_of(record, "conn", u32)
            if record.op == OP_CONNECTION:
                topic = fields.get("topic", b"").decode("utf-8", "replace")
                index.connections.setdefault(
                    number,
                    Connection(
                        number,
                        topic,
                        data[end + 4 : end + 4 + length],
                        f"{found.name}: the connection of {shown(topic)}",
                    ),
                )
            elif record.op == OP_MESSAGE and number in index.connections:
                yield at, number, time_field(record, "time"), data[end + 4 : end + 4 + length]
        except (ROSBagFormatException, KeyError, IndexError):
            return
        at = end + 4 + length
