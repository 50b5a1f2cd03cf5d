"""What TCPROS sends after its length: headers, messages, requests and responses, cut out of a stream of bytes."""

from __future__ import annotations

import struct

from rosmini.core.errors import DeserializationError
from rosmini.core.graph.headers import HEADER_LIMIT

MESSAGE_LIMIT = 1_000_000_000
"""The longest message that is read, as in roscpp."""

CHUNK = 64 * 1024
LARGE = 1024 * 1024

PROTOCOLS = {
    **dict.fromkeys(
        (b"GET ", b"POST", b"HEAD", b"PUT ", b"OPTI", b"HTTP"), "HTTP, as XML-RPC and browsers do"
    ),
    b"RTPS": "RTPS, as nodes of ROS 2 do",
    b"SSH-": "SSH",
    b"\x16\x03": "TLS",
}
"""What else is spoken on networks, by the first bytes."""

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
        self.is_deaf = False
        """True: what comes from now on is thrown away."""

    @property
    def wanted(self) -> int:
        """How many bytes to ask the socket for: up to the end of a large frame, so that none is copied twice."""
        return min(max(self._missing, CHUNK), LARGE)

    @property
    def is_cut(self) -> bool:
        """Whether a frame has begun that is not complete."""
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
        """Return what is wrong with a length that is too great."""
        if self._limit != HEADER_LIMIT:
            return f"a message of {length} bytes was announced; at most {self._limit} are read"
        spoken = next((name for start, name in PROTOCOLS.items() if bytes_of_it.startswith(start)), None)
        if spoken is not None:
            return f"it speaks {spoken}, not TCPROS, the protocol of ROS 1"
        return f"a connection header of {length} bytes was announced; at most {self._limit} are read"
