"""Wrong answers to the exercises of the chapter Topics and messages."""

from __future__ import annotations

import hashlib
import struct
from typing import TYPE_CHECKING, Any

from rosmini.book.exercises.topics_and_messages import WHEEL
from rosmini.core.graph import Graph
from rosmini.msgs import define_message
from rosmini.msgs.std_msgs.msg import String

if TYPE_CHECKING:
    from collections.abc import Callable


def _board(
    *, latch: bool = True, ordered: bool = True, name: str = "board", between: str = "; ", keep: bool = True
) -> Callable[[], Any]:
    def start(graph: Graph) -> None:
        node = graph.node(name)
        board = node.publisher("board", String, queue_size=10, latch=latch)
        notes: dict[str, str] = {}

        def pin(message: Any) -> None:
            if not keep:
                notes.clear()
            notes[message._connection_header["callerid"]] = message.data
            board.publish(between.join(f"{who}: {notes[who]}" for who in (sorted(notes) if ordered else notes)))

        node.subscriber("note", String, pin)

    return lambda: start


def _wheel_but(old: str, new: str) -> Callable[[], Any]:
    return lambda: WHEEL.replace(old, new)


def _lines(text: str) -> list[str]:
    return [line.partition("#")[0].strip() for line in text.splitlines() if line.partition("#")[0].strip()]


def _md5(lines: list[str]) -> str:
    return hashlib.md5("\n".join(lines).encode(), usedforsecurity=False).hexdigest()


def _squeezed(line: str) -> str:
    left, equals, value = line.partition("=")
    return " ".join(left.split()) + equals + value.strip()


def _as_they_come(text: str) -> str:
    return _md5([_squeezed(line) for line in _lines(text)])


def _spaces_kept(text: str) -> str:
    return _md5(sorted(_lines(text), key=lambda line: "=" not in line))


def _fields_only(text: str) -> str:
    return _md5([_squeezed(line) for line in _lines(text) if "=" not in line])


def _in_capitals(text: str) -> str:
    return str(define_message("demo/Type", text)._md5sum).upper()


def _decoder(kind: str = "d", *, order: str = "<", letters: bool = False) -> Callable[[], Any]:
    def decode(data: bytes) -> dict[str, float]:
        (count,) = struct.unpack_from(f"{order}I", data)
        offset, names = 4, []
        for _ in range(count):
            (length,) = struct.unpack_from(f"{order}I", data, offset)
            name = data[offset + 4 : offset + 4 + length].decode()
            names.append(name)
            offset += 4 + (len(name) if letters else length)
        return dict(zip(names, struct.unpack_from(f"{order}{count}{kind}", data, offset + 4), strict=True))

    return lambda: decode


MISTAKES = {
    "wheel_type": [
        _wheel_but("uint8 LEFT=0\n", ""),
        _wheel_but("RIGHT=1", "RIGHT=2"),
        _wheel_but("uint8 LEFT", "int8 LEFT"),
        _wheel_but("float64", "float32"),
        _wheel_but("float32[4]", "float32[]"),
        _wheel_but("uint8 side\nfloat64 angle\n", "float64 angle\nuint8 side\n"),
        _wheel_but("Header header", "Header head"),
        _wheel_but("float32[4] speeds", "float32[4] speeds\nbool slips"),
        _wheel_but("float64", "double"),
        lambda: 42,
    ],
    "fingerprint": [
        lambda: lambda text: hashlib.md5(text.encode(), usedforsecurity=False).hexdigest(),
        lambda: _as_they_come,
        lambda: _spaces_kept,
        lambda: _fields_only,
        lambda: _in_capitals,
        lambda: lambda _: "",
    ],
    "decode": [
        _decoder("f"),
        _decoder(order=">"),
        _decoder(letters=True),
        lambda: lambda _: {"left": 1.5, "right": -2.0},
        lambda: list,
    ],
    "board": [
        _board(latch=False),
        _board(ordered=False),
        _board(name="notice_board"),
        _board(between=", "),
        _board(keep=False),
        lambda: lambda graph: graph.node("board"),
    ],
}
