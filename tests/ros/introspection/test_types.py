"""Types and their definitions."""

from __future__ import annotations

import pytest

from rosmini.core.errors import UnknownPackage, UnknownType
from rosmini.msgs.definition import parse_message
from rosmini.ros.introspection.types import MESSAGE, SERVICE, tree


def test_constants_come_first_and_nested_fields_are_indented() -> None:
    specs = {
        "a/Outer": parse_message("Inner[2] many\nuint8 ON=1 # a comment\nstring text", "a/Outer"),
        "a/Inner": parse_message("float64 x", "a/Inner"),
    }
    assert tree(specs["a/Outer"], specs.__getitem__) == "uint8 ON=1\na/Inner[2] many\n  float64 x\nstring text\n"


def test_messages_of_actions_are_listed() -> None:
    assert "actionlib_tutorials/FibonacciActionGoal" in MESSAGE.of_package("actionlib_tutorials")
    assert "actionlib_tutorials" in MESSAGE.packages()
    assert "actionlib_tutorials" not in SERVICE.packages()


def test_what_is_not_there() -> None:
    with pytest.raises(UnknownPackage):
        MESSAGE.of_package("no_such_package")
    with pytest.raises(UnknownType):
        SERVICE.md5("std_srvs/Nope")
    assert SERVICE.of_package("std_msgs") == []
    assert SERVICE.search("SetBool") == ["std_srvs/SetBool"]
    assert SERVICE.what_next("SetBol") == "did you mean SetBool?"
