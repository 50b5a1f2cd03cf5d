"""What TCPROS sends after its length: headers, messages, requests and responses, cut out of a stream of bytes."""

from __future__ import annotations

import struct

from rosmini.errors import DeserializationError
from rosmini.graph.headers import HEADER_LIMIT

MESSAGE_LIMIT = 1_000_000_000
"""The longest message that is read, as in roscpp."""

CHUNK = 64 * 1024
LARGE = 1024 * 1024

_length_of = struct.Struct("<I").unpack_from


class FrameReader:
    """Cuts a stream into frames; it holds no more bytes than have arrived, whatever a length promises.

    The first frame is a connection header. ``ok_byte``: each later one has a byte before its length, which says whether
    a service call went well; the frame then begins with that byte.
    """

    def __init__(self, *, ok_byte: bool = False) -> None:
        self._limit = HEADER_LIMIT
        self._lead = 0
        self._later_lead = 1 if ok_byte else 0
        self._parts: list[bytes] = []
        self._have = 0
        self._need = 0

    @property
    def wanted(self) -> int:
        """How many bytes to ask the socket for: up to the end of a large frame, so that none is copied twice."""
        return min(max(self._need - self._have, CHUNK), LARGE)

    def feed(self, data: bytes) -> list[bytes]:
        """Return the frames that these bytes complete. Raises ``DeserializationError`` for a length over the limit."""
        if self._parts:
            self._parts.append(data)
            self._have += len(data)
            if self._have < self._need:
                return []
            data = b"".join(self._parts)
            self._parts = []
        frames: list[bytes] = []
        offset, end = 0, len(data)
        need = 4 + self._lead
        while end - offset >= 4 + self._lead:
            start = offset + self._lead + 4
            (length,) = _length_of(data, offset + self._lead)
            if length > self._limit:
                what = "a connection header" if self._limit == HEADER_LIMIT else "a message"
                msg = f"{what} of {length} bytes was announced; at most {self._limit} are read"
                raise DeserializationError(msg)
            stop = start + length
            if stop > end:
                need = stop - offset
                break
            frames.append(data[offset : offset + self._lead] + data[start:stop])
            offset = stop
            if self._limit == HEADER_LIMIT:
                self._limit, self._lead = MESSAGE_LIMIT, self._later_lead
            need = 4 + self._lead
        rest = data[offset:]
        self._have, self._need = len(rest), need
        if rest:
            self._parts.append(rest)
        return frames
