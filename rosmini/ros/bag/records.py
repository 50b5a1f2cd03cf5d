"""The bytes of a ROS bag, version 2.0 (http://wiki.ros.org/Bags/Format/2.0): records, their headers, compression.

A record is a header and data, each preceded by its length. A header is a list of ``name=value`` fields, each likewise.

The package rosbags also reads and writes bags, and the tests compare ours with it. It cannot replace this module: it
keeps only the connection header fields that it knows, opens no bag without an index, and writes a chunk to the file
only when it is complete.
"""

from __future__ import annotations

import bz2
import contextlib
import io
import os
import re
import struct
from collections.abc import Mapping
from typing import Any, BinaryIO, NamedTuple

from rosmini.core.errors import shown

from .errors import ROSBagEncryptNotSupportedException, ROSBagException, ROSBagFormatException, UnknownCompression

MAGIC = b"#ROSBAG V2.0\n"
HEADER_ROOM = 4096
"""Length of header and padding of the first record, which is rewritten when the bag is closed [bytes]."""

OP_MESSAGE, OP_BAG_HEADER, OP_INDEX, OP_CHUNK, OP_CHUNK_INFO, OP_CONNECTION = 2, 3, 4, 5, 6, 7
MESSAGE_MARK = b"\x04\x00\x00\x00op=\x02"
"""The field that distinguishes a message's header from a connection's."""

MAX_HEADER_BYTES = 16 * 1024 * 1024
"""Maximum length of a record header [bytes]; a greater length means damage."""
MAX_CHUNK_BYTES = 2**27
"""Maximum length of a decompressed chunk [bytes]; a file of a few kilobytes may claim any length."""
TRUSTED_CHUNK = 2**24
"""Length from which a chunk may be at most `RATIO` times as long as its compressed form [bytes]."""
RATIO = 2000
"""Ratio of a chunk's length to its compressed length that no chunk of useful data exceeds."""
MAX_TRUSTED_BYTES = 2**26
"""Maximum total that all chunks of a file may hold beyond `RATIO` times their compressed lengths [bytes]."""
FAR = 2**32
"""Position from which the end of the file is checked first [bytes]; systems refuse to seek too far past it."""
PIECE = 1024 * 1024
"""Maximum read from the disk or a decompressor before it is known that so much data exists [bytes]."""

NSECS = 1_000_000_000
LATEST = 2**32 * NSECS - 1
"""Latest time that ROS can write [ns]."""


class Compression:
    """Available compressions of chunks."""

    NONE = "none"
    BZ2 = "bz2"
    LZ4 = "lz4"


COMPRESSIONS = (Compression.NONE, Compression.BZ2, Compression.LZ4)

u32 = struct.Struct("<I")
u64 = struct.Struct("<Q")
stamp = struct.Struct("<II")
index_entry = struct.Struct("<III")


class Truncated(ROSBagFormatException):
    """The file ends within a record."""


class Record(NamedTuple):
    """Position and header fields of a record; its data is still in the file."""

    position: int
    fields: dict[str, bytes]
    data_position: int
    data_length: int

    @property
    def op(self) -> int:
        """Kind of the record (op code)."""
        return self.fields["op"][0]

    @property
    def end(self) -> int:
        """Position of the next record."""
        return self.data_position + self.data_length


def pack_fields(fields: Mapping[str, bytes]) -> bytes:
    """Return the bytes of header fields, without a leading length."""
    parts = []
    for name, value in fields.items():
        entry = name.encode() + b"=" + value
        parts += [u32.pack(len(entry)), entry]
    return b"".join(parts)


def parse_fields(header: bytes, where: str) -> dict[str, bytes]:
    """Return the fields of a header. Raises ``ROSBagFormatException``, which names ``where``, for an invalid header."""
    fields: dict[str, bytes] = {}
    at, end = 0, len(header)
    while at < end:
        if at + 4 > end:
            raise ROSBagFormatException(f"{where}: a header field is cut off: the file is damaged")
        length = u32.unpack_from(header, at)[0]
        name, equals, value = header[at + 4 : at + 4 + length].partition(b"=")
        if at + 4 + length > end or not equals:
            raise ROSBagFormatException(f"{where}: a header field is not name=value: the file is damaged or not a bag")
        fields[name.decode("utf-8", "replace")] = value
        at += 4 + length
    return fields


def pack_record(fields: Mapping[str, bytes], data: bytes = b"") -> bytes:
    """Return the bytes of a record."""
    return record_start(fields, len(data)) + data


def record_start(fields: Mapping[str, bytes], length: int) -> bytes:
    """Return the bytes of a record up to its data, which has this length."""
    header = pack_fields(fields)
    return b"".join((u32.pack(len(header)), header, u32.pack(length)))


def read_exactly(file: BinaryIO, length: int, what: str) -> bytes:
    """Read ``length`` bytes. Raises ``Truncated`` before allocating memory if there are fewer."""
    data = b"" if length > PIECE and length > _left(file) else file.read(length)
    if len(data) < length:
        raise Truncated(f"the file ends within {what}: it is truncated. `rosbag reindex` saves what is in it.")
    return data


def _left(file: BinaryIO) -> int:
    """Return the number of bytes from the current position to the end of the file."""
    here = file.tell()
    end = file.seek(0, os.SEEK_END)
    file.seek(here)
    return end - here


def read_record(file: BinaryIO, position: int) -> Record | None:
    """Read the header of the record at ``position``; None at the end of the file.

    Raises ``Truncated`` if the file ends within it, ``ROSBagFormatException`` if it is not a record.
    """
    where = f"the record at byte {position}"
    if position > FAR and position >= file.seek(0, os.SEEK_END):
        return None
    file.seek(position)
    start = file.read(4)
    if not start:
        return None
    if len(start) < 4:
        raise Truncated(f"the file ends within {where}: it is truncated")
    length = u32.unpack(start)[0]
    if length > MAX_HEADER_BYTES:
        raise ROSBagFormatException(
            f"{where}: a header of {length} bytes: the file is damaged or not a bag (or encrypted)"
        )
    fields = parse_fields(read_exactly(file, length, where), where)
    if len(fields.get("op", b"")) != 1:
        raise ROSBagFormatException(f"{where} does not say what it is (no field op): the file is damaged")
    data_length = u32.unpack(read_exactly(file, 4, where))[0]
    return Record(position, fields, position + 8 + length, data_length)


def field(record: Record, name: str, layout: struct.Struct) -> int:
    """Return a number from a record's header. Raises ``ROSBagFormatException`` if it is missing."""
    value = record.fields.get(name)
    if value is None or len(value) != layout.size:
        raise ROSBagFormatException(
            f"the record at byte {record.position} has no valid field {name!r}: the file is damaged"
        )
    return int(layout.unpack(value)[0])


def time_field(record: Record, name: str) -> int:
    """Return a time from a record's header [ns]. Raises ``ROSBagFormatException`` if ROS could not have written it."""
    packed = field(record, name, u64)
    time = (packed & 0xFFFFFFFF) * NSECS + (packed >> 32)
    if time > LATEST:
        raise ROSBagFormatException(
            f"the record at byte {record.position} has a {name!r} that is not a time: the file is damaged"
        )
    return time


def pack_time(nanoseconds: int) -> bytes:
    """Return a time as stored in a bag."""
    return stamp.pack(*divmod(nanoseconds, NSECS))


def compress(data: bytes, compression: str) -> bytes:
    """Return a chunk's data as stored in the file."""
    if compression == Compression.BZ2:
        return bz2.compress(data)
    if compression == Compression.LZ4:
        import lz4.frame

        # The only form that ROS's reader accepts: independent blocks, with a checksum over the content.
        packed: bytes = lz4.frame.compress(
            data, block_size=lz4.frame.BLOCKSIZE_MAX4MB, block_linked=False, content_checksum=True, store_size=False
        )
        return packed
    return data


def _decompressor(compression: str) -> Any:
    if compression == Compression.BZ2:
        return bz2.BZ2Decompressor()
    import lz4.frame

    return lz4.frame.LZ4FrameDecompressor()


def most_unpacked(packed: int) -> int:
    """Return the maximum decompressed size of a chunk of ``packed`` bytes."""
    return min(MAX_CHUNK_BYTES, max(TRUSTED_CHUNK, RATIO * packed))


def _unpack(data: bytes, compression: str, most: int, saved: io.BytesIO) -> None:
    """Decompress data into ``saved`` and stop once it holds ``most`` bytes.

    Raises the decompressor's errors on damage.
    """
    decompressor = _decompressor(compression)
    for start in range(0, len(data), PIECE):
        piece = data[start : start + PIECE]
        while not decompressor.eof and saved.tell() < most:
            saved.write(decompressor.decompress(piece, max_length=min(most - saved.tell(), PIECE)))
            piece = b""
            if decompressor.needs_input:
                break


def check_unpacked(size: int, packed: int, compression: str, position: int) -> None:
    """Raise ``ROSBagFormatException`` if a chunk of ``packed`` bytes claims an implausible size."""
    if size > most_unpacked(packed):
        raise ROSBagFormatException(
            f"the {compression} chunk at byte {position} has {packed:,} bytes and claims to hold {size:,}; at most "
            f"{most_unpacked(packed):,} are unpacked: the file is damaged, or made to harm"
        )


class Allowance:
    """Counts what the chunks of one file hold beyond `RATIO`: many small chunks may claim as much as a large one."""

    def __init__(self) -> None:
        self._left = MAX_TRUSTED_BYTES

    def charge(self, size: int, packed: int) -> None:
        """Count a chunk before it is decompressed. Raises ``ROSBagFormatException`` beyond `MAX_TRUSTED_BYTES`."""
        self._left -= max(0, min(size, most_unpacked(packed)) - RATIO * packed)
        if self._left < 0:
            raise ROSBagFormatException(
                f"its chunks claim to hold {MAX_TRUSTED_BYTES:,} bytes more than {RATIO} times their compressed "
                "lengths: the file is damaged, or made to harm"
            )


def decompress(data: bytes, compression: str, size: int, position: int) -> bytes:
    """Return a chunk's data, decompressing at most ``size`` bytes.

    Raises ``ROSBagFormatException`` if it is damaged or would be too large, ``ROSBagException`` if the compression is
    unknown.
    """
    if compression not in COMPRESSIONS:
        raise ROSBagException(
            f"the chunk at byte {position} is compressed with {shown(compression)}; a bag may use "
            f"{', '.join(COMPRESSIONS)}"
        )
    plain = data
    if compression != Compression.NONE:
        check_unpacked(size, len(data), compression, position)
        saved = io.BytesIO()
        try:
            _unpack(data, compression, size + 1, saved)
        except (OSError, ValueError, EOFError, RuntimeError) as error:
            raise ROSBagFormatException(
                f"the {compression} chunk at byte {position} does not decompress: the file is damaged ({error})"
            ) from error
        plain = saved.getvalue()
    if len(plain) != size:
        there = f"more than {size:,}" if len(plain) > size and plain is not data else f"{len(plain):,}"
        raise ROSBagFormatException(
            f"the chunk at byte {position} should have {size:,} bytes and has {there}: the file is damaged"
        )
    return plain


def rescue(data: bytes, compression: str, most: int) -> bytes:
    """Return the data that can be recovered from a truncated chunk, up to a number of bytes."""
    if compression == Compression.NONE:
        return data[:most]
    if compression not in COMPRESSIONS:
        return b""
    saved = io.BytesIO()
    with contextlib.suppress(OSError, ValueError, EOFError, RuntimeError):  # what came before the damage counts
        _unpack(data, compression, min(most, most_unpacked(len(data))), saved)
    return saved.getvalue()


def check_compression(compression: str) -> str:
    """Return ``compression`` if it exists. Raises ``UnknownCompression`` otherwise."""
    if compression not in COMPRESSIONS:
        raise UnknownCompression(f"no compression {shown(compression)}: use one of {', '.join(COMPRESSIONS)}")
    return compression


def check_threshold(size: Any) -> int:
    """Return ``size`` if it is a valid number of bytes. Raises ``ValueError`` otherwise."""
    if not isinstance(size, int) or size < 0:
        raise ValueError(f"chunk_threshold must be a number of bytes, not {shown(size)}")
    return size


def check_magic(file: BinaryIO, name: str) -> int:
    """Go to the first record and return the version of the format, 200 for 2.0.

    Like ROS's reader, this treats a bag of any version 2 as 2.0. Raises ``ROSBagFormatException`` if ``file`` is not
    such a bag.
    """
    file.seek(0)
    start = file.read(len(MAGIC))
    if not start:
        raise ROSBagFormatException(f"{name} is an empty file, not a bag: was its recording ended before it began?")
    version = re.match(rb"#ROS.* V([0-9])\.([0-9])", start)
    if version is not None and version[1] == b"2" and start.endswith(b"\n") and len(start) == len(MAGIC):
        return 200 + int(version[2])
    if version is not None:
        number = b".".join(version.groups()).decode()
        raise ROSBagFormatException(
            f"{name} is a bag of version {number}; only 2.0 is read here. Real ROS converts it: `rosbag fix`."
        )
    if MAGIC.startswith(start):
        raise ROSBagFormatException(f"{name} has only {len(start)} bytes of a bag in it: nothing was recorded")
    if start.startswith(b"SQLite"):
        raise ROSBagFormatException(f"{name} is a database, perhaps a bag of ROS 2: not a ROS 1 bag")
    if start.startswith(b"\x89MCAP"):
        raise ROSBagFormatException(f"{name} is an MCAP file: not a ROS 1 bag")
    raise ROSBagFormatException(f"{name} does not appear to be a bag file: it begins with {start[:8]!r}")


def bag_header(index_position: int, connections: int, chunks: int) -> bytes:
    """Return the first record, padded to its fixed length."""
    fields = {
        "chunk_count": u32.pack(chunks),
        "conn_count": u32.pack(connections),
        "index_pos": u64.pack(index_position),
        "op": bytes([OP_BAG_HEADER]),
    }
    return pack_record(fields, b" " * (HEADER_ROOM - len(pack_fields(fields))))


def encryption(record: Record, name: str) -> None:
    """Raise ``ROSBagEncryptNotSupportedException`` if the first record says that the bag is encrypted."""
    encryptor = record.fields.get("encryptor", b"").decode("utf-8", "replace")
    if encryptor:
        user = record.fields.get("gpg_user", b"").decode("utf-8", "replace")
        whom = f" for the GPG user {user}" if user else ""
        raise ROSBagEncryptNotSupportedException(
            f"{name} is encrypted ({encryptor}){whom}: decrypt it with real ROS first: `rosbag decrypt {name}`"
        )
