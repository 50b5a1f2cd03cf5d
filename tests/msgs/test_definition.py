"""Reading definition files: what is in them, and what is wrong with them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DefinitionError
from rosmini.msgs import message_class, service_class
from rosmini.msgs.definition import parse_message, parse_service, split_action
from rosmini.msgs.registry import Registry, registry

MakeRegistry = Callable[[dict[str, str]], Registry]


def test_md5_sums_of_all_known_types_equal_those_of_real_ros(root: Path) -> None:
    known = json.loads((root / "tests" / "data" / "ros_md5.json").read_text(encoding="utf-8"))
    reg = registry()
    ours = {}
    for name in known:
        package, _, short = name.partition("/")
        make = service_class if short in reg.services(package) else message_class
        ours[name] = make(name)._md5sum
    assert len(known) == 311
    assert ours == known


def test_fields_are_resolved_and_keep_their_order() -> None:
    spec = parse_message(
        "Header header\nPoint[] points # a comment\nfloat32[3] v\nother_msgs/X x\ntime t\n", "my_msgs/Y"
    )
    assert [(field.type, field.name) for field in spec.fields] == [
        ("std_msgs/Header", "header"),
        ("my_msgs/Point[]", "points"),
        ("float32[3]", "v"),
        ("other_msgs/X", "x"),
        ("time", "t"),
    ]
    assert spec.has_header


def test_constants_keep_what_ros_keeps() -> None:
    spec = parse_message("string S = a # b = c  \nint8 I=-128 # low\nbool B=True\nfloat32 F = 1.50\n", "my_msgs/Y")
    assert {c.name: (c.value, c.text) for c in spec.constants} == {
        "S": ("a # b = c", "a # b = c"),
        "I": (-128, "-128"),
        "B": (True, "True"),
        "F": (1.5, "1.50"),
    }


def test_a_service_is_two_messages_and_an_action_seven() -> None:
    service = parse_service("int64 a\n---\nint64 sum\n", "my_msgs/Add")
    assert (service.request.name, service.response.fields[0].name) == ("my_msgs/AddRequest", "sum")
    assert sorted(split_action("int32 g\n---\n---\nint32 f\n", "my_msgs/Do")) == [
        "my_msgs/DoAction", "my_msgs/DoActionFeedback", "my_msgs/DoActionGoal", "my_msgs/DoActionResult",
        "my_msgs/DoFeedback", "my_msgs/DoGoal", "my_msgs/DoResult",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("int32 a\nint32\n", 2, "a field is 'type name', this has one word"),
        ("int32 a b\n", 1, "this has 3 words"),
        ("int32\ta\n", 1, "by a space, not by a tab"),
        ("int32 2a\n", 1, "'2a' is not a field name"),
        ("int32 a\n# fine\nfloat64 a\n", 3, "'a' is declared twice, first in line 1"),
        ("int32 A=1\nint32 A\n", 2, "'A' is declared twice"),
        ("int32[<=3] a\n", 1, "exist in ROS 2 only"),
        ("int32[3][2] a\n", 1, "is not a type"),
        ("int8 X=128\n", 1, "128 does not fit into int8 (-128 to 127)"),
        ("uint64 X=18446744073709551616\n", 1, "does not fit into uint64"),
        ("int8 X=1.5\n", 1, "'1.5' is no int8 value"),
        ("bool B=maybe\n", 1, "'maybe' is no bool value"),
        ("Point X=1\n", 1, "'Point' cannot be the type of a constant"),
        ("in8 X=1\n", 1, "did you mean"),
        ("int8 X=1=2\n", 1, "one '='"),
        (" string X=a\n", 1, "at the beginning of its line"),
        ("int8 serialize\n", 1, "cannot be the name of a field"),
        ("int8 a\n---\nint8 b\n", 2, "services belong in .srv"),
    ],
)
def test_a_broken_message_is_reported_with_its_line(text: str, line: int, words: str) -> None:
    with pytest.raises(DefinitionError) as caught:
        parse_message(text, "my_msgs/Broken", "/ws/my_msgs/msg/Broken.msg")
    assert (caught.value.file, caught.value.line) == ("/ws/my_msgs/msg/Broken.msg", line)
    assert words in str(caught.value)
    assert text.split("\n")[line - 1].strip() in str(caught.value)
    assert "my_msgs/Broken" in str(caught.value)


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("int64 a\n", 2, "a line '---' is missing"),
        ("int64 a\n---\n---\n", 3, "one line '---' too many"),
        ("int64 a\n---\nint64 b\nint64 2\n", 4, "not a field name"),
    ],
)
def test_a_broken_service_is_reported_with_its_line_in_the_file(text: str, line: int, words: str) -> None:
    with pytest.raises(DefinitionError, match=words) as caught:
        parse_service(text, "my_msgs/Broken", "Broken.srv")
    assert caught.value.line == line


def test_a_broken_action_is_reported_with_its_line_in_the_file() -> None:
    with pytest.raises(DefinitionError, match="is missing"):
        split_action("int32 a\n---\nint32 b\n", "my_msgs/Do", "Do.action")
    with pytest.raises(DefinitionError, match="not a field name") as caught:
        split_action("int32 a\n---\nint32 b\n---\nint32 c!\n", "my_msgs/Do", "Do.action")
    assert caught.value.line == 5


@pytest.mark.parametrize(
    ("field", "words"),
    [
        ("Pare other", "did you mean Pair?"),
        ("geometry_msgs/Poynt p", "did you mean geometry_msgs/Point"),
        ("geometry_msg/Point p", "did you mean geometry_msgs"),
        ("flaot32 x", "did you mean float32"),
        ("Header[] h", "write std_msgs/Header"),
        ("Bad again", "a message cannot contain itself: my_msgs/Bad -> my_msgs/Bad"),
        ("Circle c", "my_msgs/Bad -> my_msgs/Circle -> my_msgs/Bad"),
    ],
)
def test_a_field_of_an_impossible_type_is_reported_with_its_line(
    make_registry: MakeRegistry, field: str, words: str
) -> None:
    reg = make_registry(
        {
            "my_msgs/msg/Pair.msg": "int32 a\nint32 b\n",
            "my_msgs/msg/Bad.msg": f"int32 a\n{field}\n",
            "my_msgs/msg/Circle.msg": "Bad back\n",
        }
    )
    with pytest.raises(DefinitionError) as caught:
        reg.message_class("my_msgs/Bad")
    assert words in str(caught.value)
    assert caught.value.file is not None


def test_a_file_that_is_not_utf8_is_reported_with_its_line(make_registry: MakeRegistry, tmp_path: Path) -> None:
    reg = make_registry({"my_msgs/msg/Latin.msg": ""})
    (tmp_path / "my_msgs" / "msg" / "Latin.msg").write_bytes(b"int32 a\n# gr\xf6sse\n")
    with pytest.raises(DefinitionError, match="not UTF-8") as caught:
        reg.message_class("my_msgs/Latin")
    assert caught.value.line == 2


def test_a_repaired_file_is_read_again(make_registry: MakeRegistry) -> None:
    reg = make_registry({"my_msgs/msg/Pair.msg": "int32\n"})
    with pytest.raises(DefinitionError):
        reg.message_class("my_msgs/Pair")
    make_registry({"my_msgs/msg/Pair.msg": "int32 a\n"})
    assert reg.message_class("my_msgs/Pair").__slots__ == ["a"]


def test_windows_line_ends_do_not_matter(make_registry: MakeRegistry, tmp_path: Path) -> None:
    reg = make_registry({"my_msgs/msg/Pair.msg": ""})
    (tmp_path / "my_msgs" / "msg" / "Pair.msg").write_bytes(b"int32 a\r\nstring S=x\r\n")
    cls = reg.message_class("my_msgs/Pair")
    assert (cls.__slots__, cls.S, "\r" in cls._full_text) == (["a"], "x", False)


@given(st.text(alphabet=st.sampled_from(list("int32 string[]=#/-\n\tabA1.")), max_size=80))
def test_any_text_is_parsed_or_refused_with_a_line(text: str) -> None:
    refusals = []
    try:
        spec = parse_message(text, "my_msgs/Any")
        assert len({field.name for field in spec.fields}) == len(spec.fields)
    except DefinitionError as error:
        refusals.append(error.line)
    assert all(line is not None and 1 <= line <= text.count("\n") + 1 for line in refusals)
