"""Names alone; tests/interop/test_rosgraph_names.py compares resolution with real ROS."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core import names
from rosmini.core.errors import IllegalName, ROSInitException
from rosmini.core.names import AnonymousNames, Remappings, canonicalize, join, namespace, resolve, split_resource_name


@pytest.mark.parametrize(
    ("name", "resolved"),
    [
        ("/chatter", "/chatter"),
        ("chatter", "/ns/chatter"),
        ("a/b", "/ns/a/b"),
        ("~rate", "/ns/talker/rate"),
        ("~", "/ns/talker/"),
        ("", "/ns/"),
        ("/", "/"),
        ("//a//b/", "/a/b"),
        ("~/rate", "/rate"),
    ],
)
def test_resolve(name: str, resolved: str) -> None:
    assert resolve(name, "/ns", "/ns/talker") == resolved
    assert resolve(name, "/ns/", "/ns/talker") == resolved


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


@pytest.mark.parametrize("name", ["", "ns/talker", "~talker", "3talker", "_talker", "tal ker"])
def test_illegal_base_names(name: str) -> None:
    with pytest.raises(IllegalName, match="node name"):
        names.check_base_name(name)


@given(st.text(max_size=12))
def test_validation_ends_with_an_answer_or_one_caret(name: str) -> None:
    if names.GRAPH_NAME.fullmatch(name):
        assert resolve(name, "/ns", "/ns/node").startswith("/")
        return
    with pytest.raises(IllegalName) as caught:
        names.check_name(name)
    assert str(caught.value).splitlines()[2].strip() == "^"


legal = st.from_regex(r"\A[~/A-Za-z][A-Za-z0-9_/]{0,10}\Z")


@given(legal)
def test_resolved_names_are_global_canonical_and_stay(name: str) -> None:
    resolved = resolve(name, "/ns", "/ns/node")
    assert resolved.startswith("/")
    assert "//" not in resolved
    assert resolve(resolved, "/other", "/other/node") == canonicalize(resolved)


def test_namespace_and_join() -> None:
    assert [namespace(name) for name in ("/wg/node1", "/wg/", "/node", "node", "", "/")] == [
        "/wg/",
        "/",
        "/",
        "/",
        "/",
        "/",
    ]
    assert join("/ns", "a") == join("/ns/", "a") == "/ns/a"
    assert join("", "a") == "a"
    assert join("~", "a") == "~a"
    assert join("/ns", "/a") == "/a"
    assert join("/ns", "~a") == "~a"


def test_remappings_from_a_command_line() -> None:
    argv = [
        "talker.py", "chatter:=/robot1/chatter", "--verbose", "__name:=t2", "__ns:=robot1", "_rate:=10", "x=1",
        "a b:=c",
    ]  # fmt: skip
    found = Remappings.from_argv(argv)
    assert found.names == {"chatter": "/robot1/chatter"}
    assert found.node_name == "t2"
    assert found.namespace == "/robot1"
    assert found.private_parameters == {"rate": 10}
    assert Remappings.other_arguments(argv) == ["talker.py", "--verbose", "x=1", "a b:=c"]
    assert Remappings().node_name is None
    assert Remappings().namespace is None


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("10", 10),
        ("1.5", 1.5),
        ("1e5", "1e5"),  # YAML 1.1 as PyYAML reads it, and rospy with it: a float needs a point and a sign
        ("1.0e+5", 1e5),
        ("true", True),
        ("[1, 2]", [1, 2]),
        ("{a: 1}", {"a": 1}),
        ("''", ""),
        ("some text", "some text"),
        ("0x10", 16),
    ],
)
def test_private_parameters_are_yaml(text: str, value) -> None:
    found = Remappings.from_argv([f"_p:={text}"]).private_parameters["p"]
    assert found == value
    assert type(found) is type(value)


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


def test_both_sides_of_a_remapping_are_resolved() -> None:
    rules = Remappings({"chatter": "talk", "/odom": "/ns/odom", "~cmd": "cmd", "x": "~x", "__ns": "ns"})

    def here(name: str) -> str:
        return resolve(name, "/ns", "/ns/node", rules)

    assert here("chatter") == here("/ns/chatter") == "/ns/talk"
    assert here("/odom") == here("/ns/odom") == "/ns/odom"
    assert here("/chatter") == "/chatter"
    assert here("~cmd") == "/ns/cmd"
    assert here("x") == "/ns/node/x"
    assert resolve("chatter", "/", "/other", rules) == "/talk"


def test_remappings_are_applied_once() -> None:
    swap = Remappings({"a": "b", "b": "a"})
    assert [resolve(name, "/", "/n", swap) for name in ("a", "b", "c")] == ["/b", "/a", "/c"]


def test_anonymous_names_are_the_same_on_each_run() -> None:
    first, second = AnonymousNames(100), AnonymousNames(100)
    made = [first.make("talker", 1_500_000_000), first.make("talker", 1_500_000_000)]
    assert made == ["talker_100_1500", "talker_101_1500"]
    assert second.make("talker", 1_500_000_000) == made[0]
    assert names.check_base_name(made[1]) == made[1]


def test_package_resource_names() -> None:
    assert split_resource_name("std_msgs/String") == ("std_msgs", "String")
    assert split_resource_name("String", "std_msgs") == ("std_msgs", "String")
    for wrong in ("String", "/String", "a/b/C", "std_msgs/", "", None):
        with pytest.raises(IllegalName, match="package/Type"):
            split_resource_name(wrong)
