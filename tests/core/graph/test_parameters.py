"""The parameter tree: setting, getting, deleting, searching, and what a value may be."""

from datetime import datetime

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import ParameterError
from rosmini.core.graph.parameters import ParameterTree, updates, wire_copy

scalars = (
    st.booleans()
    | st.integers(-(2**31), 2**31 - 1)
    | st.floats(allow_nan=False)
    | st.text(max_size=5)
    | st.binary(max_size=5)
)
names = st.from_regex(r"\A[a-z][a-z0-9_]{0,5}\Z")
values = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3), max_leaves=8
)


@given(names, values)
def test_what_is_set_is_what_is_got(name: str, value) -> None:
    tree = ParameterTree()
    tree.set(f"/ns/{name}", value)
    assert tree.get(f"/ns/{name}") == value
    assert tree.get("/") == {"ns": {name: value}}
    tree.delete(f"/ns/{name}")
    assert tree.get("/") == {"ns": {}}


@given(st.dictionaries(names, values, max_size=4))
def test_every_listed_name_is_set(content) -> None:
    tree = ParameterTree()
    tree.set("/", content)
    assert all(name in tree for name in tree.names())


def test_values_are_private_copies() -> None:
    tree = ParameterTree()
    given_value = {"a": [1, 2]}
    tree.set("/x", given_value)
    given_value["a"].append(3)
    tree.get("/x")["a"].append(4)
    assert tree.get("/x") == {"a": [1, 2]}


def test_a_dictionary_replaces_the_namespace_and_a_value_gives_way() -> None:
    tree = ParameterTree()
    tree.set("/x", {"a": 1, "b": 2})
    tree.set("/x", {"c": 3})
    assert tree.names() == ["/x/c"]
    tree.set("/x/c/d", 4)
    assert tree.get("/x") == {"c": {"d": 4}}


def test_names_come_in_the_order_of_setting() -> None:
    tree = ParameterTree()
    for name in ("/z", "/a/c", "/m", "/a/b"):
        tree.set(name, 1)
    assert tree.names() == ["/z", "/a/c", "/a/b", "/m"]


@pytest.mark.parametrize("key", ["/", "/none", "/x/none", "/x/y/z"])
def test_what_is_not_there_cannot_be_deleted(key: str) -> None:
    tree = ParameterTree()
    tree.set("/x/y", "text")
    with pytest.raises(KeyError):
        tree.delete(key)
    assert tree.get("/x/y") == "text"


def test_the_root_is_a_dictionary() -> None:
    with pytest.raises(ParameterError, match="root of parameter tree"):
        ParameterTree().set("/", 5)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ({"sizes": [1, 2, 2**31]}, r"/robot/sizes\[2\]: 2147483648 does not fit into 32 bits"),
        (-(2**31) - 1, "does not fit into 32 bits"),
        ({"a": {"b": None}}, "/robot/a/b: a parameter cannot be None"),
        ({1: 2}, "/robot: the key 1 is no str"),
        ([{1, 2}], r"/robot\[0\]: a parameter cannot be {1, 2} \(a set\)"),
        (1j, "use bool, int, float, str"),
    ],
)
def test_what_ros_cannot_hold_is_named(value, text: str) -> None:
    tree = ParameterTree()
    with pytest.raises(ParameterError, match=text):
        tree.set("/robot", value)
    assert tree.names() == []


def test_wire_copy_is_what_xmlrpc_delivers() -> None:
    when = datetime(2020, 1, 2, 3, 4, 5)
    assert wire_copy((1, (2, b"x"), when)) == [1, [2, b"x"], when]


def test_search_goes_up_and_looks_for_the_first_part_only() -> None:
    tree = ParameterTree()
    tree.set("/robot/arm", 1)
    tree.set("/pr2/robot/base", 2)
    assert tree.search("/pr2/foo", "robot") == "/pr2/robot"
    assert tree.search("/pr2/foo", "robot/arm") == "/pr2/robot/arm"
    assert tree.search("/other/foo", "robot/arm") == "/robot/arm"
    assert tree.search("/pr2", "none") is None
    assert tree.search("/pr2", "/robot") == "/robot"


def test_who_hears_of_a_change() -> None:
    subscribed = ["/", "/w/", "/w/v/", "/w/v/deep/", "/wide/"]
    assert updates(subscribed, "/w/v", 3) == [("/", "/w/v/", 3), ("/w/", "/w/v/", 3), ("/w/v/", "/w/v/", 3)]
    tree = {"v": {"deep": 1}}
    assert updates(subscribed, "/w", tree) == [
        ("/", "/w/", tree),
        ("/w/", "/w/", tree),
        ("/w/v/", "/w/v/", {"deep": 1}),
        ("/w/v/deep/", "/w/v/deep/", 1),
    ]
    assert updates(["/w/v/"], "/w", {}) == [("/w/v/", "/w/v/", {})]
