"""Splits a TCPROS byte stream into length-prefixed frames: headers, messages, requests and responses."""

from __future__ import annotations

import struct

from rosmini.core.errors import DeserializationError
from rosmini.core.graph.headers import HEADER_LIMIT

MESSAGE_LIMIT = 1_000_000_000
"""Maximum length of a message, as in roscpp [bytes]."""

CHUNK = 64 * 1024
LARGE = 1024 * 1024

PROTOCOLS = {
    **dict.fromkeys((b"GET ", b"POST", b"HEAD", b"PUT ", b"OPTI", b"HTTP"), "HTTP, as XML-RPC and browsers do"),
    b"RTPS": "RTPS, as nodes of ROS 2 do",
    b"SSH-": "SSH",
    b"\x16\x03": "TLS",
}
"""Other network protocols, by their first bytes."""

_length_of = struct.Struct("<I").unpack_from


class FrameReader:
    """Splits a stream into frames; it buffers only bytes that have arrived, whatever a length claims.

    The first frame is a connection header. With ``ok_byte``, each later one has a byte before its length, which says if
    a service call succeeded; the frame then begins with that byte.
    """

    def __init__(self, *, ok_byte: bool = False) -> None:
        self._limit = HEADER_LIMIT
        self._lead = 0
        self._later_lead = 1 if ok_byte else 0
        self._start = b""
        self._parts: list[bytes] = []
        self._missing = 0
        self.is_deaf = False
        """True if further data is discarded."""

    @property
    def wanted(self) -> int:
        """Number of bytes to read from the socket: up to the end of a large frame, to avoid copying."""
        return min(max(self._missing, CHUNK), LARGE)

    @property
    def is_cut(self) -> bool:
        """True if a frame has begun but is not complete."""
        return bool(self._missing or self._start)

    def feed(self, data: bytes) -> list[bytes]:
        """Return the frames that these bytes complete. Raises ``DeserializationError`` for a length over the limit."""
        if self.is_deaf:
            self._start, self._parts = b"", []
            return []
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
                raise DeserializationError(self._refusal(length, data[start - 4 : start]))
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

    def _refusal(self, length: int, bytes_of_it: bytes) -> str:
        """Return the error message for a length that is too great."""
        if self._limit != HEADER_LIMIT:
            return f"a message of {length} bytes was announced; at most {self._limit} are read"
        spoken = next((name for start, name in PROTOCOLS.items() if bytes_of_it.startswith(start)), None)
        if spoken is not None:
            return f"it speaks {spoken}, not TCPROS, the protocol of ROS 1"
        return f"a connection header of {length} bytes was announced; at most {self._limit} are read"
