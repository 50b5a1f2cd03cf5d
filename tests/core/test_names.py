"""Names alone; tests/interop/test_rosgraph_names.py compares resolution with real ROS."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core import names
from rosmini.core.errors import IllegalName, ROSInitException
from rosmini.core.names import Remappings, resolve


def test_without_a_node_there_are_no_private_names() -> None:
    assert resolve("chatter", "/") == "/chatter"
    assert resolve("chatter", "/a/b") == "/a/b/chatter"
    with pytest.raises(IllegalName, match="~rate is private to a node"):
        resolve("~rate", "/")


@pytest.mark.parametrize(
    ("name", "caret", "reason"),
    [
        ("my robot/scan", 2, "a space is not allowed: use '_' instead"),
        ("camera-left", 6, "'-' is not allowed: use '_' instead"),
        ("2d_map", 0, "it starts with '2'"),
        ("_hidden", 0, "it starts with '_'"),
        ("a/~b", 2, "'~' may only be the first character"),
        ("température", 4, "'é' is not allowed"),
        ("http://x:1/", 4, "':' is not allowed"),
        ("scan\n", 4, "'\\n' is not allowed"),
        ("a\tb c", 1, "'\\t' is not allowed"),
        ("日本", 0, "'日' is not allowed"),
        ("a٣", 1, "'٣' is not allowed"),
    ],
)
def test_the_caret_stands_under_the_offender(name: str, caret: int, reason: str) -> None:
    with pytest.raises(IllegalName) as caught:
        resolve(name, "/", what="topic")
    title, shown, pointer, explanation = str(caught.value).split("\n")
    assert title == "illegal topic:"
    assert pointer.index("^") == 4 + caret
    assert shown[4 : 4 + caret] == name[:caret]
    assert explanation.startswith(reason + "; allowed are a letter, '/' or '~'")


@pytest.mark.parametrize("name", [None, 5, b"scan"])
def test_a_name_is_a_string(name) -> None:
    with pytest.raises(IllegalName, match="a name is a str, not"):
        resolve(name, "/")


@given(st.text(max_size=12))
def test_validation_ends_with_an_answer_or_one_caret(name: str) -> None:
    if names.GRAPH_NAME.fullmatch(name):
        assert resolve(name, "/ns", "/ns/node").startswith("/")
        return
    with pytest.raises(IllegalName) as caught:
        names.check_name(name)
    assert str(caught.value).splitlines()[2].strip() == "^"


legal = st.from_regex(r"\A[~/A-Za-z][A-Za-z0-9_/]{0,10}\Z")


def test_an_empty_target_says_nothing() -> None:
    found = Remappings.from_argv(["_p:=", "a:=", "__name:="])
    assert (found.private_parameters, found.names, found.special) == ({}, {}, {})


@pytest.mark.parametrize(
    "argument",
    [
        "a:=b:=c", "_p:=[1, 2", "_p:={", "_p:=2026-13-45", "_p:=" + "[" * 5000, "_p:=!!timestamp 1", "_p:=&a [*a]",
        "_p:=" + "9" * 5000,
    ],
    ids=lambda argument: argument[:12],
)  # fmt: skip
def test_arguments_that_mean_nothing(argument: str) -> None:
    with pytest.raises(ROSInitException, match="invalid"):
        Remappings.from_argv([argument])
