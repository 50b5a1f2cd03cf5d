"""YAML in and out. `tests/interop/rosparam_peer.py` compares types and namespaces with those of the real rosparam."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.rosparam import RosParamException, dumps, load_file, load_str, parse

names = st.from_regex(r"\A[a-zA-Z][a-zA-Z0-9_]{0,5}\Z")
scalars = (
    st.booleans()
    | st.integers(-(2**31), 2**31 - 1)
    | st.floats(allow_nan=False)
    | st.text(st.characters(codec="utf-8", exclude_categories=["Cs", "Cc"]), max_size=8)
    | st.binary(max_size=5)
)
values = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3), max_leaves=8
)


@given(st.dictionaries(names, values, max_size=4))
def test_what_is_written_is_read_again(tree: dict[str, Any]) -> None:
    assert [document.values for document in load_str(dumps(tree))] == [tree]


@pytest.mark.parametrize("text", ["rad(pi)", "deg(90)", "true", "5", "1e5", "", "null", "- a", "x: y"])
def test_a_text_stays_a_text(text: str) -> None:
    assert parse(dumps({"a": text})) == {"a": text}


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    with suppress(RosParamException):
        assert all(dumps(document.values) for document in load_str(text))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb: [1, 2\nc: 3\n", r"p\.yaml:3: this is not YAML: .*expected ',' or '\]'"),
        ("a:\n\tb: 1\n", r"p\.yaml:2: .*indent with spaces, not with tabs"),
        ("a: 1\nb: rad(2*tau)\n", r"p\.yaml:2: 'rad\(2\*tau\)' is not an angle"),
        ("a: 1\nb: !degrees north\n", r"p\.yaml:2: 'north' is not an angle"),
        ("a: 1\n\nb: !robot x\n", r"p\.yaml:3: .*!robot"),
        ("a: &x [1, *x]\n", r"p\.yaml:1: this value contains itself"),
        ("a: 1\n---\n---\nb: 2\n", r"p\.yaml:3: this document is empty"),
        ("a: \x07", r"p\.yaml: this is not YAML: .*character 3"),
        ("a: 1\nb: 2026-13-45\n", r"p\.yaml:2: this is not YAML: .*2026-13-45.* is no timestamp: month"),
        ("- " * 5000 + "x", "nested too deeply"),
        *(
            (f"a: {value}\n", r"p\.yaml:1: this is not YAML")
            for value in ("!!float ''", "!!int ''", "!!int '-'", "!!bool maybe", "!!timestamp 1", "[!!float '']")
        ),
    ],
)
def test_what_cannot_be_read_is_named_with_its_line(text: str, message: str) -> None:
    with pytest.raises(RosParamException, match=message):
        load_str(text, "p.yaml")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb:\n  c:\n  d: 2\n", r"p\.yaml:3: parameter /r/b/c has no value .* write '' for an empty text"),
        ("a: 1\nb: [1,\n  2, 4294967296]\n", r"p\.yaml:3: parameter /r/b\[2\]: 4294967296 does not fit"),
        ("a:\n  1: one\n", r"p\.yaml:2: parameter /r/a: the key 1 is not a string: quote it"),
        ("a: 1\nb: [{c: 1}, {2: 1}]\n", r"p\.yaml:2: parameter /r/b\[1\]: the key 2 is not a string"),
        ("day: 2020-01-02\n", r"p\.yaml:1: parameter /r/day: a date cannot be stored"),
        ("!!set {a, b}\n", r"p\.yaml:1: parameter /r: a set cannot be stored"),
    ],
)
def test_what_the_server_cannot_hold_is_named_with_its_line(text: str, message: str) -> None:
    (document,) = load_str(text, "p.yaml", "/r")
    with pytest.raises(RosParamException, match=message):
        document.assignments()


def test_the_root_is_a_dictionary() -> None:
    (document,) = load_str("- 1\n- 2\n", "p.yaml")
    with pytest.raises(RosParamException, match=r"p\.yaml:1: the root .* is a dictionary, not \["):
        document.assignments()


def test_aliases_do_not_make_a_small_file_huge() -> None:
    text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
        f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]\n" for n in range(1, 9)
    )
    with pytest.raises(RosParamException, match="are allowed"):
        load_str(text)


def test_merge_keys_and_aliases() -> None:
    text = "base: &base {a: 1, b: 2}\nmore:\n  <<: *base\n  b: 3\n"
    assert load_str(text)[0].values == {"base": {"a": 1, "b": 2}, "more": {"a": 1, "b": 3}}


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("größe: 5\n", encoding="utf-8")
    assert load_file(path)[0].values == {"größe": 5}
    path.write_bytes(b"\xff\xfe\xfa")
    with pytest.raises(RosParamException, match=r"p\.yaml: cannot read"):
        load_file(path)
    with pytest.raises(RosParamException, match=r"file \[.*none\.yaml\] does not exist"):
        load_file(tmp_path / "none.yaml")
    with pytest.raises(RosParamException, match="cannot read"):
        load_file(tmp_path)
