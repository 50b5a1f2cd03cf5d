"""The parameter tree: setting, getting, deleting, searching, and what a value may be."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import ParameterError
from rosmini.core.graph.parameters import ParameterTree

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


def test_a_dictionary_replaces_the_namespace_and_a_value_gives_way() -> None:
    tree = ParameterTree()
    tree.set("/x", {"a": 1, "b": 2})
    tree.set("/x", {"c": 3})
    assert tree.names() == ["/x/c"]
    tree.set("/x/c/d", 4)
    assert tree.get("/x") == {"c": {"d": 4}}


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


def test_search_goes_up_and_looks_for_the_first_part_only() -> None:
    tree = ParameterTree()
    tree.set("/robot/arm", 1)
    tree.set("/pr2/robot/base", 2)
    assert tree.search("/pr2/foo", "robot") == "/pr2/robot"
    assert tree.search("/pr2/foo", "robot/arm") == "/pr2/robot/arm"
    assert tree.search("/other/foo", "robot/arm") == "/robot/arm"
    assert tree.search("/pr2", "none") is None
    assert tree.search("/pr2", "/robot") == "/robot"
