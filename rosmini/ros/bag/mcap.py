"""Convert bags to MCAP files (https://mcap.dev/spec), which Foxglove opens, and back; the message bytes stay the same.

The profile is `ros1`: messages are encoded as on ROS 1's wire (`ros1`), schemas are message definitions (`ros1msg`),
and channel metadata holds the fields of the connection header (https://mcap.dev/spec/registry).
"""

from __future__ import annotations

import io
import os
import struct
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import IO, Any, BinaryIO

from rosmini.core.errors import DefinitionError, UnknownPackage, UnknownType, shown
from rosmini.core.time import Time
from rosmini.msgs.full_text import class_from

from .bag import Bag
from .errors import ROSBagException, ROSBagFormatException
from .records import PIECE, Allowance, Compression, check_unpacked, decompress
from .tools import Copied, two_files

IN_OTHER_FIELDS = ("topic", "type", "message_definition")
"""Fields of the connection header that are stored elsewhere in the file."""


def to_mcap(source: Bag | str | os.PathLike[str], target: str | os.PathLike[str]) -> Copied:
    """Write all messages of a bag, open or not, to a new MCAP file, compressed with lz4.

    Raises:
        ROSBagException: the bag cannot be read, or the package `mcap` is not installed. No file is left behind.
        OSError: the file cannot be written.

    """
    if not isinstance(source, Bag):
        two_files(source, target)
        with Bag(source) as bag:
            return to_mcap(bag, target)
    writer_of = _writer()
    part = Path(f"{os.fspath(target)}.active")
    try:
        with part.open("wb") as file:
            copied = _copy(source, writer_of, file)
        part.replace(target)
    except BaseException:
        with suppress(OSError):
            part.unlink()
        raise
    return copied


def _writer() -> Any:
    try:
        from mcap.writer import CompressionType, Writer
    except ImportError as error:
        raise ROSBagException(
            "MCAP files are written with the package mcap, which is not installed here: `pip install mcap`"
        ) from error
    return lambda file: Writer(file, compression=CompressionType.LZ4)


def _copy(bag: Bag, writer_of: Any, file: IO[bytes]) -> Copied:
    writer = writer_of(file)
    writer.start(profile="ros1", library="rosmini")
    schemas: dict[tuple[str, str], int] = {}
    channels: dict[int, int] = {}
    counts: dict[int, int] = {}
    for conn, time, data, _, _ in bag.read_raw():
        if conn.id not in channels:
            schema = schemas.get((conn.type, conn.md5sum))
            if schema is None:
                schema = writer.register_schema(conn.type, "ros1msg", conn.definition.encode())
                schemas[conn.type, conn.md5sum] = schema
            metadata = {name: conn.text(name) for name in sorted(conn.header) if name not in IN_OTHER_FIELDS}
            channels[conn.id] = writer.register_channel(conn.topic, "ros1", schema, metadata)
        count = counts[conn.id] = counts.get(conn.id, -1) + 1
        writer.add_message(channels[conn.id], time, data, time, count)
    writer.finish()
    total = sum(counts.values()) + len(counts)
    return Copied(total, total)


def from_mcap(source: str | os.PathLike[str], target: str | os.PathLike[str] | BinaryIO) -> Copied:
    """Write all messages of an MCAP file with a ROS 1 profile to a bag, in the order of the file.

    Raises:
        ROSBagException: it is not an MCAP file or is damaged, a channel is not from ROS 1, or the package `mcap` is not
            installed. No file is left behind.
        OSError: a file cannot be read or written.

    """
    if isinstance(target, str | os.PathLike):
        two_files(source, target)
        part = Path(f"{os.fspath(target)}.active")
        try:
            with part.open("wb") as made:
                copied = from_mcap(source, made)
            part.replace(target)
        except BaseException:
            with suppress(OSError):
                part.unlink()
            raise
        return copied
    with Path(source).open("rb") as file, Bag(target, "w") as bag:
        written = 0
        connections: dict[int, tuple[Any, dict[str, str]]] = {}
        for schema, channel, message in _messages(file, os.fspath(source)):
            if channel.id not in connections:
                connections[channel.id] = _connection(schema, channel, os.fspath(source))
            cls, header = connections[channel.id]
            raw = (header["type"], message.data, header["md5sum"], cls)
            time = Time(*divmod(message.log_time, 10**9))
            bag.write(channel.topic, raw, time, raw=True, connection_header=header)
            written += 1
    return Copied(written, written)


def _messages(file: IO[bytes], name: str) -> Iterator[tuple[Any, Any, Any]]:
    """Yield schema, channel and message of each message, in file order."""
    try:
        from mcap.exceptions import McapError
        from mcap.records import Channel, Message, Schema
    except ImportError as error:
        raise ROSBagException(
            "MCAP files are read with the package mcap, which is not installed here: `pip install mcap`"
        ) from error
    schemas: dict[int, Any] = {}
    channels: dict[int, Any] = {}
    try:
        for record in _records(file):
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                channels[record.id] = record
            elif isinstance(record, Message):
                if record.channel_id not in channels:
                    raise ValueError(f"a message of the channel {record.channel_id}, which comes nowhere before it")
                channel = channels[record.channel_id]
                yield schemas.get(channel.schema_id), channel, record
    except (McapError, ValueError, OverflowError, struct.error, ROSBagFormatException) as error:
        raise ROSBagException(
            f"{name} is not an MCAP file, or is damaged before byte {file.tell()}: {error}"
        ) from error


def _records(file: IO[bytes]) -> Iterator[Any]:
    """Yield all records of the file; chunks are decompressed here, since the library does so without a size limit."""
    from mcap.records import Chunk
    from mcap.stream_reader import StreamReader

    bounded: Any = _Bounded(file)
    allowance = Allowance()
    for record in StreamReader(bounded, emit_chunks=True, validate_crcs=True).records:
        if isinstance(record, Chunk):
            position = file.tell() - len(record.data)
            allowance.charge(record.uncompressed_size, len(record.data))
            data = _unpacked(record.data, record.compression, record.uncompressed_size, position)
            yield from _in_chunk(replace(record, compression="", data=data))
        else:
            yield record


class _Bounded:
    """A file that refuses to read past its end; the library would try to read any length that the file claims."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._left = os.fstat(file.fileno()).st_size

    def read(self, length: int) -> bytes:
        if not 0 <= length <= self._left:
            raise ROSBagFormatException(f"a length of {length:,} bytes where {self._left:,} bytes are left")
        data = self._file.read(length)
        self._left -= len(data)
        return data


def _in_chunk(chunk: Any) -> Iterator[Any]:
    """Yield the records of a decompressed chunk one by one; there may be millions of them."""
    from mcap.opcode import Opcode
    from mcap.records import Channel, Message, Schema
    from mcap.stream_reader import get_chunk_data_stream

    stream, size = get_chunk_data_stream(chunk, validate_crc=True)
    while stream.count < size:
        opcode, length = stream.read1(), stream.read8()
        if length > size - stream.count:
            raise ROSBagFormatException(f"a record of {length:,} bytes is longer than its chunk")
        if opcode == Opcode.CHANNEL:
            yield Channel.read(stream)
        elif opcode == Opcode.MESSAGE:
            yield Message.read(stream, length)
        elif opcode == Opcode.SCHEMA:
            yield Schema.read(stream)
        else:
            stream.read(length)


def _unpacked(data: bytes, compression: str, size: int, position: int) -> bytes:
    """Return the data of a chunk, decompressing no more than its stated size. Raises ``ROSBagException``."""
    if compression != "zstd":
        return decompress(data, compression or Compression.NONE, size, position)
    from zstandard import ZstdDecompressor, ZstdError

    check_unpacked(size, len(data), compression, position)
    saved = io.BytesIO()
    try:
        with ZstdDecompressor().stream_reader(data, read_across_frames=True) as reader:
            while saved.tell() <= size and (piece := reader.read(PIECE)):
                saved.write(piece)
    except ZstdError as error:
        raise ROSBagFormatException(f"the zstd chunk at byte {position} does not decompress: {error}") from error
    if saved.tell() != size:
        raise ROSBagFormatException(
            f"the zstd chunk at byte {position} claims to hold {size:,} bytes and holds "
            f"{'more' if saved.tell() > size else f'{saved.tell():,}'}"
        )
    return saved.getvalue()


def _connection(schema: Any, channel: Any, name: str) -> tuple[Any, dict[str, str]]:
    """Return the class of a channel's messages, and its connection header."""
    encodings = (channel.message_encoding, None if schema is None else schema.encoding)
    if encodings != ("ros1", "ros1msg"):
        raise ROSBagException(
            f"{channel.topic} in {name} is encoded as {encodings[0]!r:.40} with a schema of {encodings[1]!r:.40}: only "
            "ROS 1's messages ('ros1', 'ros1msg') can be read here"
        )
    definition = schema.data.decode("utf-8", "replace")
    try:
        cls = class_from(schema.name, definition)
    except (UnknownType, UnknownPackage, DefinitionError) as error:
        raise ROSBagException(f"the definition of {shown(schema.name)} in {name} is broken: {error}") from error
    known = {"topic": channel.topic, "type": schema.name, "message_definition": definition}
    return cls, {"md5sum": cls._md5sum, **channel.metadata, **known}
