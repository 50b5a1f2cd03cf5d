"""Wrong answers to the exercises of the chapter The wire."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any
from xmlrpc.client import ServerProxy

if TYPE_CHECKING:
    from collections.abc import Callable


# ---- fields_of: a header ----


def _fields(
    cut: Callable[[str], list[str]] = lambda field: field.split("=", 1), *, checked: bool = True
) -> Callable[[], Any]:
    def read(data: bytes) -> dict[str, str]:
        fields, at = {}, 0
        while at < len(data):
            (length,) = struct.unpack("<I", data[at : at + 4].ljust(4, b"\0"))
            field = data[at + 4 : at + 4 + length]
            if checked and (len(field) < length or at + 4 > len(data)):
                raise ValueError("cut off")
            name, value = (cut(field.decode()) + [""])[:2]
            fields[name] = value
            at += 4 + length
        return fields

    return lambda: read


# ---- hear: a subscriber ----


def _hear(*, register: bool = True, read_all: bool = True, header_is_message: bool = False) -> Callable[[], Any]:
    """A subscriber that looks for no error, and may have further faults."""

    def hear(master: Any, connect: Any, topic: str, kind: str, md5sum: str) -> bytes:
        ask = master.registerSubscriber if register else master.registerPublisher
        uri = ask("/ear", topic, kind, "http://localhost:9/")[2]
        if not register:
            return b""
        with ServerProxy(uri[0]) as node:
            address: Any = node.requestTopic("/ear", topic, [["TCPROS"]])
        _, host, port = address[2]
        sock = connect((host, port))
        fields = (f"callerid=/ear|topic={topic}|type={kind}|md5sum={md5sum}").encode().split(b"|")
        body = b"".join(struct.pack("<I", len(field)) + field for field in fields)
        sock.sendall(struct.pack("<I", len(body)) + body)

        def read(count: int) -> bytes:
            data: bytes = sock.recv(count)
            while read_all and len(data) < count:
                data += sock.recv(count - len(data))
            return data

        def frame() -> bytes:
            return read(struct.unpack("<I", read(4).ljust(4, b"\0"))[0])

        first = frame()
        return first if header_is_message else frame()

    return lambda: hear


# ---- decide: stop, in bytes ----


def _decide(limit: float = 0.5, speed: float = 0.2, turn: float = 0.0, form: str = "<I6d") -> Callable[[], Any]:
    def decide(scan: bytes) -> bytes:
        (ahead,) = struct.unpack_from("<f", scan, 57)
        return struct.pack(form, 48, speed if ahead > limit else 0.0, 0.0, 0.0, 0.0, 0.0, turn)

    return lambda: decide


MISTAKES = {
    "fields_of": [
        _fields(lambda field: field.split("=")),
        _fields(lambda field: field.rsplit("=", 1)),
        _fields(checked=False),
        lambda: lambda data: data,
        lambda: lambda _: {},
        lambda: lambda data: {b"topic": data},
    ],
    "culprits": [
        lambda: ["topic", "md5sum", "type"],
        lambda: ["callerid", "md5sum", "md5sum"],
        lambda: ["topic", "md5sum"],
        lambda: {"topic", "md5sum", "type"},
    ],
    "hear": [
        _hear(),
        _hear(register=False),
        _hear(read_all=False),
        _hear(header_is_message=True),
        lambda: lambda *_: b"\x05\x00\x00\x00extra",
    ],
    "decide": [
        _decide(limit=1.5),
        _decide(limit=0.0),
        _decide(speed=0.0),
        _decide(turn=0.5),
        _decide(form=">I6d"),
        _decide(form="<I6f"),
        lambda: lambda _: b"",
    ],
}
