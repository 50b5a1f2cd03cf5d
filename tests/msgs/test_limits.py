"""Definitions from outside: names that are no names, and types that would not fit into memory."""

from __future__ import annotations

import struct
import tracemalloc
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import DefinitionError, DeserializationError, UnknownType
from rosmini.msgs import define_action, define_message, define_service, message_class
from rosmini.msgs.codegen import source
from rosmini.msgs.definition import MAX_TEXT, parse_message
from rosmini.msgs.limits import MAX_DEPTH, MAX_EMPTY, MAX_FIELDS

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

PAYLOAD = "X(0)\n    __import__('os').abort()\n    y"
NAMES = [
    PAYLOAD, "a b", "a;b", "a\n0", "", "1a", "_a", "a" * 300, "ä", "a.b", "a/b", "../a", "a'b", "__class__",
]  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_what_is_no_name_is_the_name_of_nothing(name: str) -> None:
    define: list[Callable[[str, str], Any]] = [define_message, define_service, define_action]
    texts = ["int32 a\n", "int32 a\n---\n", "int32 a\n---\n---\n"]
    for make, text in zip(define, texts, strict=True):
        for kind in (f"pkg/{name}", f"{name}/Type"):
            with pytest.raises(DefinitionError, match="is not a type name: write package/Type"):
                make(kind, text)
    with pytest.raises(UnknownType, match="is no message type: it is written package/Type"):
        message_class(f"pkg/{name}")
    for line in (f"int32 {name}", f"int32 {name}=1", f"string {name}=1", f"{name or '[]'} field", f"pkg/{name} field"):
        with pytest.raises(DefinitionError):
            define_message("pkg/Type", line)


def test_no_name_from_outside_is_in_generated_source() -> None:
    cls = define_message(
        "pkg_name/TypeName", "int32 number_name\nstring[] text_name\nHeader header_name\nuint8 CONSTANT_NAME=1\n"
    )
    for purpose in ("init", "freeze", "thaw", "thaw_numpy", "thaw_genpy_numpy", "encode", "read"):
        text = source(cls, purpose)
        assert text.startswith(f"def {purpose}(")
        assert "_name" not in text.replace("_names", "").lower()
    message = cls(number_name=3, text_name=["a"])
    assert cls._decode(cls._encode(message)).text_name == ["a"]
    assert cls._freeze(message).number_name == 3


def nest(make_registry: Any, levels: int, text: str, last: str) -> Any:
    """A type of so many levels, each with ``text`` in which ``T`` is the next level."""
    files = {f"deep/msg/L{level}.msg": text.replace("T", f"L{level + 1}") for level in range(levels)}
    return make_registry({**files, f"deep/msg/L{levels}.msg": last}).message_class("deep/L0")


@pytest.mark.parametrize(
    ("levels", "text", "last", "problem"),
    [
        (
            0,
            "",
            "int8 a\nfloat64[99999999999] x\n",
            "L0.msg:2: field 'x' makes the message too large: its default value",
        ),
        (0, "", f"uint8[{10**18 - 1}] x\n", "field 'x' makes the message too large: its default value"),
        (0, "", f"uint8[{'9' * 5000}] x\n", "is an array of more elements than anything can hold"),
        (0, "", "string[100000000] x\n", "field 'x' makes the message too large: its default value"),
        (0, "", "time[100000000] x\n", "field 'x' makes the message too large: its default value"),
        (9, "T[10] inner\n", "float64 x\n", "field 'inner' makes the message too large: its default value"),
        (40, "T a\nT b\n", "int8 x\n", f"field 'b' makes the message too large: more than {MAX_FIELDS:,} fields"),
        (40, "T a\nT b\n", "", f"field 'b' makes the message too large: more than {MAX_EMPTY} empty messages"),
        (5, "T[4] a\n", "", f"field 'a' makes the message too large: more than {MAX_EMPTY} empty messages"),
        (MAX_DEPTH + 1, "T a\n", "int8 x\n", f"more than {MAX_DEPTH} levels of messages in messages"),
        (200, "T a\n", "int8 x\n", f"more than {MAX_DEPTH} levels of messages in messages"),
        (0, "", "".join(f"int8 a{i}\n" for i in range(MAX_FIELDS + 1)), f"more than {MAX_FIELDS:,} fields"),
    ],
    ids=range(12),
)
def test_a_type_that_is_too_large_names_the_field(
    make_registry: Any, levels: int, text: str, last: str, problem: str
) -> None:
    tracemalloc.start()
    try:
        with pytest.raises(DefinitionError, match=r"^.*\.msg:[0-9]+: ") as caught:
            nest(make_registry, levels, text, last)
        assert tracemalloc.get_traced_memory()[1] < 30_000_000
    finally:
        tracemalloc.stop()
    assert problem in str(caught.value)
    assert len(str(caught.value)) < 1000


def test_a_file_that_is_no_definition_is_not_read(make_registry: Any, tmp_path: Path) -> None:
    reg = make_registry(
        {"my_msgs/msg/Long.msg": "#" * (MAX_TEXT + 1), "my_msgs/msg/Dos.msg": "int32 a\r\nstring B=x\r\n"}
    )
    with pytest.raises(DefinitionError, match=r"Long\.msg: the file cannot be read: it has more than 1.0\d+ MB"):
        reg.message_class("my_msgs/Long")
    assert reg.message_class("my_msgs/Dos").B == "x"
    assert reg.source.read("my_msgs", "msg", "../../Long") is None
    (tmp_path / "my_msgs" / "msg" / "a b.msg").write_text("int32 a\n", encoding="utf-8")
    with pytest.raises(UnknownType, match="'my_msgs/a b' is no message type"):
        reg.message_class("my_msgs/a b")


def test_what_is_large_and_real_is_allowed(make_registry: Any) -> None:
    image = define_message("pkg/Image", f"uint8[{6 * 1024 * 1024}] data\nfloat64[100000] ranges\n")()
    assert len(image.data) == 6 * 1024 * 1024
    assert nest(make_registry, MAX_DEPTH - 1, "T a\n", "int8 x\n")()
    assert define_message("pkg/Wide", "".join(f"int8 a{i}\n" for i in range(1000)))(a999=3).a999 == 3


def test_empty_messages_on_the_wire_are_counted(make_registry: Any) -> None:
    reg = make_registry({"my_msgs/msg/Many.msg": "std_msgs/Empty[] many\n", "my_msgs/msg/More.msg": "Many[] more\n"})
    many, more = reg.message_class("my_msgs/Many"), reg.message_class("my_msgs/More")
    assert len(many().deserialize(struct.pack("<I", MAX_EMPTY)).many) == MAX_EMPTY
    with pytest.raises(DeserializationError, match="field many claims"):
        many._decode(struct.pack("<I", MAX_EMPTY + 1))
    with pytest.raises(DeserializationError, match="field many claims"):
        more._decode(struct.pack("<III", 2, 1, 2**32 - 1))


@pytest.mark.parametrize(
    "text",
    [
        "#" * MAX_TEXT + "\n",
        "int32 " + "a" * 100_000,
        "a" * 100_000 + " x",
        "int32 X=" + "9" * 100_000,
        "bool X=" + "(" * 100_000,
        "bool X=" + "(" * 900,
        "a" * 100_000 + " X=1",
        "int32 " + "a" * 100_000 + "=1",
        "float64[" + "9" * 100_000 + "] x",
        "int32 a " * 10_000,
        "\0",
        "\ud800 x",
        "string A=\ud800",
    ],
    ids=range(13),
)
def test_definitions_with_long_texts_are_refused_in_few_words(text: str) -> None:
    with pytest.raises(DefinitionError, match=r"^f\.msg") as caught:
        parse_message(text, "pkg/Type", "f.msg")
    assert len(str(caught.value)) < 1000
