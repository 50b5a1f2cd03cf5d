"""Mutated definitions and bytes, the same ones each time: a class, a message or our error, in bounded memory."""

from __future__ import annotations

import random
import tracemalloc
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import DeserializationError, RosminiError
from rosmini.msgs import define_action, define_message, define_service, message_class
from rosmini.msgs.registry import registry
from rosmini.ros.bag.index import connection
from rosmini.ros.bag.types import recorded_class

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

MEGABYTE = 1024 * 1024
ROUNDS = 40

TYPES = [
    "sensor_msgs/LaserScan",
    "visualization_msgs/Marker",
    "nav_msgs/Odometry",
    "diagnostic_msgs/DiagnosticArray",
    "rosgraph_msgs/Log",
]
ACTION = (
    "# goal\nint32 order\nuint8 A=1\n---\nint32[] sequence\nstring NAME= x # y\n---\n"
    "geometry_msgs/Pose[3] poses\nHeader header\n"
)
PIECES = [
    "[]", "[3]", "[99999999999]", "[-1]", "[999]", "[", "]", "=", "= ", "=1", "=-1", "#", "---", "\n---\n", "\n",
    "\r\n", "\t", " ", "  ", "/", "//", "..",
    "int32", "uint8", "float64", "string", "bool", "time", "duration", "Header", "std_msgs/Empty", "p/T", "T", "byte",
    "char", "self", "from", "None", "a", "A",
    "serialize", "__class__", "X=1e999", "X=" + "9" * 400, "X=0x10", "X=True", "X=()", "=" * 80,
    "\n" + "=" * 80 + "\nMSG: p/T\n", "MSG: ", "\0", "ä", "\ud800",
    "'", '"', "\\", "{", "}", "%s", "import os", "<=3", "wstring", "int32 a\n" * 50, "p/T a\n" * 5, "x" * 300,
]  # fmt: skip


def mutated(rng: random.Random, text: str) -> str:
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(text) + 1)
        end = min(len(text), at + rng.choice([0, 0, 1, 3, 20]))
        kind = rng.randrange(4)
        if kind == 0:
            text = text[:at] + rng.choice(PIECES) + text[end:]
        elif kind == 1:
            text = text[:at] + text[end:]
        elif kind == 2:
            lines = text.split("\n")
            lines.insert(rng.randrange(len(lines) + 1), rng.choice(lines))
            text = "\n".join(lines)
        else:
            words = text.split(" ")
            words[rng.randrange(len(words))] = rng.choice(PIECES)
            text = " ".join(words)
    return text


@pytest.fixture
def bounded() -> Iterator[None]:
    for name in TYPES:
        message_class(name)()
    tracemalloc.start()
    yield
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 40 * MEGABYTE


def _message(text: str) -> list[Any]:
    return [define_message("p/T", text)]


def _service(text: str) -> list[Any]:
    cls = define_service("p/T", text)
    return [cls._request_class, cls._response_class]


def _action(text: str) -> list[Any]:
    return list(define_action("p/T", text))


def _recorded(text: str) -> list[Any]:
    header = {"type": "p/T", "md5sum": "*", "message_definition": text.encode("utf-8", "replace")}
    return [recorded_class(connection(0, "/topic", header))]


@pytest.mark.usefixtures("bounded")
@pytest.mark.parametrize("make", [_message, _service, _action, _recorded])
def test_any_definition_makes_classes_or_an_error(make: Callable[[str], list[Any]]) -> None:
    rng = random.Random(make.__name__)
    texts = {
        _message: [registry().definition(name).text for name in TYPES],
        _service: [registry().definition(TYPES[0]).text + "---\n" + registry().definition(TYPES[4]).text],
        _action: [ACTION],
        _recorded: [message_class(name)._full_text for name in TYPES],
    }[make]
    made = 0
    for _ in range(ROUNDS):
        try:
            classes = make(mutated(rng, rng.choice(texts)))
        except RosminiError as error:
            assert len(str(error)) < 3000  # noqa: PT017 - many are fine
            continue
        for cls in classes:
            made += 1
            if cls._measure.memory < MEGABYTE:
                data = cls._encode(cls())
                assert cls._encode(cls._decode(data)) == data
                assert len(data) == cls._measure.wire
    assert made > ROUNDS / 20


@pytest.mark.usefixtures("bounded")
@pytest.mark.parametrize("name", TYPES)
def test_any_bytes_make_a_message_or_an_error(name: str) -> None:
    rng = random.Random(name)
    cls = message_class(name)
    whole = cls._encode(cls())
    for _ in range(10 * ROUNDS):
        data = bytearray(whole + bytes(rng.randrange(50)))
        for _ in range(rng.randint(1, 5)):
            at = rng.randrange(len(data))
            data[at : at + 4] = rng.choice(
                [b"\xff\xff\xff\xff", b"\0\0\0\0", b"\1\0\0\0", b"\xff\xff\xff\x7f", rng.randbytes(4)]
            )
        try:
            message = cls._thaw(cls._decode(bytes(data)))
        except DeserializationError as error:
            assert name in str(error)  # noqa: PT017 - some are fine
        else:
            str(message)
