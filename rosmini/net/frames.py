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
        self._start = b""
        self._parts: list[bytes] = []
        self._missing = 0
        self.first = b""
        """The first four bytes."""
        self.is_deaf = False
        """True: what comes from now on is thrown away."""

    @property
    def wanted(self) -> int:
        """How many bytes to ask the socket for: up to the end of a large frame, so that none is copied twice."""
        return min(max(self._missing, CHUNK), LARGE)

    def feed(self, data: bytes) -> list[bytes]:
        """Return the frames that these bytes complete. Raises ``DeserializationError`` for a length over the limit."""
        if self.is_deaf:
            self._start, self._parts = b"", []
            return []
        if len(self.first) < 4:
            self.first += data[: 4 - len(self.first)]
        frames: list[bytes] = []
        offset = self._missing
        if offset:
            if len(data) < offset:
                self._parts.append(data)
                self._missing -= len(data)
                return frames
            self._parts.append(data[:offset])
            frames.append(b"".join(self._parts))
            self._parts, self._missing = [], 0
        elif self._start:
            data = self._start + data
        end = len(data)
        while (start := offset + self._lead + 4) <= end:
            (length,) = _length_of(data, start - 4)
            if length > self._limit:
                what = "a connection header" if self._limit == HEADER_LIMIT else "a message"
                msg = f"{what} of {length} bytes was announced; at most {self._limit} are read"
                raise DeserializationError(msg)
            stop = start + length
            body = data[offset : start - 4] + data[start:stop]
            if self._limit == HEADER_LIMIT:
                self._limit, self._lead = MESSAGE_LIMIT, self._later_lead
            if stop > end:
                self._parts, self._missing = [body], stop - end
                offset = end
                break
            frames.append(body)
            offset = stop
        self._start = data[offset:]
        return frames
