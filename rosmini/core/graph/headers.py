"""Connection headers as bytes, which both ends of TCPROS exchange (http://wiki.ros.org/ROS/Connection%20Header)."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from rosmini.core.errors import DeserializationError

if TYPE_CHECKING:
    from .transport import Header

HEADER_LIMIT = 1024 * 1024
"""Maximum length of a header [bytes]; the longest message definition in ROS takes less than a tenth of it."""


def encode_header(fields: Header) -> bytes:
    """Return a connection header as bytes: its length, then ``key=value`` fields, each after its length, sorted."""
    parts = [f"{key}={value}".encode() for key, value in sorted(fields.items())]
    body = b"".join(struct.pack("<I", len(part)) + part for part in parts)
    return struct.pack("<I", len(body)) + body


def decode_header(data: bytes) -> Header:
    """Return the fields of a connection header. Raises ``DeserializationError`` if the bytes are invalid."""
    if len(data) < 4 or struct.unpack_from("<I", data)[0] != len(data) - 4:
        msg = f"these {len(data)} bytes are not a connection header: the total length at the start is wrong"
        raise DeserializationError(msg)
    return decode_fields(data[4:])


def decode_fields(data: bytes) -> Header:
    """Return the fields of a connection header that comes without its total length.

    Raises ``DeserializationError`` if the bytes are invalid.
    """
    if len(data) > HEADER_LIMIT:
        msg = f"a connection header of {len(data)} bytes is too long: at most {HEADER_LIMIT} are read"
        raise DeserializationError(msg)
    fields: Header = {}
    offset = 0
    while offset < len(data):
        if offset + 4 > len(data):
            msg = f"the connection header ends in the middle of a field's length, at byte {offset}"
            raise DeserializationError(msg)
        (length,) = struct.unpack_from("<I", data, offset)
        field = data[offset + 4 : offset + 4 + length]
        if len(field) != length:
            msg = f"at byte {offset} a field of the connection header claims {length} bytes; {len(field)} are left"
            raise DeserializationError(msg)
        try:
            key, separator, value = field.decode().partition("=")
        except UnicodeDecodeError as error:
            msg = f"a field of the connection header is not UTF-8 text (at byte {offset})"
            raise DeserializationError(msg) from error
        if not separator:
            msg = f"a field of the connection header has no '=': {key[:80]!r} (at byte {offset})"
            raise DeserializationError(msg)
        fields[key] = value
        offset += 4 + length
    return fields
