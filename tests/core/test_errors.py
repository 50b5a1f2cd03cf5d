"""The error tree: relatives that scripts rely on, and the texts."""

import pickle
import tracemalloc
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core import errors
from rosmini.core.errors import DefinitionError, ParameterNotSet, RosminiError, nearest, shown
from rosmini.core.time import Time
from rosmini.msgs import message_class


def test_every_error_is_a_rosmini_error() -> None:
    defined = [found for found in vars(errors).values() if getattr(found, "__module__", "") == errors.__name__]
    classes = [found for found in defined if isinstance(found, type) and issubclass(found, BaseException)]
    assert len(classes) > 20
    assert all(issubclass(cls, RosminiError) for cls in classes)
    assert all(cls.__doc__ for cls in classes)


@pytest.mark.parametrize(
    ("error", "caught_as"),
    [
        (errors.ROSInterruptException, errors.ROSException),
        (errors.ROSInterruptException, KeyboardInterrupt),
        (errors.ROSTimeMovedBackwardsException, errors.ROSInterruptException),
        (errors.ROSInitException, errors.ROSException),
        (errors.ROSSerializationException, errors.ROSException),
        (errors.TransportTerminated, errors.TransportException),
        (errors.TransportInitError, errors.TransportException),
        (errors.SerializationError, errors.MessageException),
        (errors.DeserializationError, errors.MessageException),
        (errors.IllegalName, ValueError),
        (errors.ParameterNotSet, KeyError),
        (errors.ParameterTypeError, errors.ParameterError),
        (errors.ParameterOverflow, errors.ParameterError),
        (errors.InvalidRate, ZeroDivisionError),
    ],
)
def test_scripts_can_catch_errors_by_the_names_they_know(error: type, caught_as: type) -> None:
    with pytest.raises(caught_as):
        raise error("text")


def test_definition_error_shows_where() -> None:
    assert str(DefinitionError("no such type", "a/msg/B.msg", 3)) == "a/msg/B.msg:3: no such type"
    assert str(DefinitionError("is empty", "a/package.xml")) == "a/package.xml: is empty"
    assert str(DefinitionError("no such type")) == "no such type"
    copied = pickle.loads(pickle.dumps(DefinitionError("bad", "f.msg", 7)))
    assert (copied.file, copied.line, str(copied)) == ("f.msg", 7, "f.msg:7: bad")


def test_a_missing_parameter_reads_as_a_sentence() -> None:
    assert str(ParameterNotSet("parameter [/a] is not set:\ntry this")) == "parameter [/a] is not set:\ntry this"


@pytest.mark.parametrize(
    ("name", "candidates", "clause"),
    [
        ("/chater", ["/rosout", "/chatter"], "did you mean /chatter?"),
        ("/SCAN", ["/scan"], "did you mean /scan?"),
        ("/scan", ["/robot2/scan", "/robot1/scan"], "did you mean /robot1/scan or /robot2/scan?"),
        ("/scan", ["/a/scan", "/b/scan", "/c/scan", "/d/scan"], "did you mean /a/scan, /b/scan or /c/scan?"),
        ("/camera", ["/rosout", "/tf"], ""),
        ("/scan", ["/scan"], ""),
        ("/", ["/", "/a"], ""),
        ("std_msgs/Sting", ["std_msgs/String", "std_msgs/Int8"], "did you mean std_msgs/String?"),
        ("x", [], ""),
    ],
)
def test_nearest(name: str, candidates: list[str], clause: str) -> None:
    assert nearest(name, candidates) == clause
    assert nearest(name, reversed(candidates)) == clause


plain = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**200), 2**200) | st.floats() | st.text() | st.binary(),
    lambda inner: (
        st.lists(inner)
        | st.lists(inner).map(tuple)
        | st.dictionaries(st.text() | st.integers(), inner)
        | st.sets(st.integers())
    ),
    max_leaves=20,
)


@given(plain, st.integers(0, 200))
def test_a_value_is_shown_as_its_repr_cut(value: Any, limit: int) -> None:
    whole = repr(value)
    assert shown(value, limit) == (whole if len(whole) <= limit else whole[: max(limit - 3, 0)] + "...")
    assert len(shown(value, limit)) <= max(limit, 3)


class _Broken:
    def __repr__(self) -> str:
        raise RuntimeError("no")


def _looped() -> list[Any]:
    loop: list[Any] = []
    loop.append(loop)
    return loop


def _nested(depth: int) -> list[Any]:
    inner: list[Any] = []
    for _ in range(depth):
        inner = [inner]
    return inner


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (message_class("std_msgs/String")("hello"), "String(data='hello')"),
        (Time(3, 5), repr(Time(3, 5))),
        (np.array([1.5, 2.5]), "array([1.5, 2.5])"),
        (np.zeros((480, 640), np.uint8), "<an array of uint8 of the shape (480, 640)>"),
        pytest.param(10**10_000, "<an integer of 33220 bits>", id="integer"),
        (_Broken(), "<_Broken object>"),
        (_looped(), "[" * 57 + "..."),
        (_nested(100_000), "[" * 57 + "..."),
        ((1,), "(1,)"),
    ],
)
def test_what_else_is_shown(value: Any, text: str) -> None:
    assert shown(value) == text


def test_showing_a_huge_value_needs_no_memory() -> None:
    text = "a" * 20_000_000
    values: list[Any] = [
        text, text.encode(), bytearray(text.encode()), [1.5] * 1_000_000, {"key": [text]},
        message_class("std_msgs/String")(text), np.array([text], object), np.array([text[:1_000_000]]),
    ]  # fmt: skip
    tracemalloc.start()
    try:
        for value in values:
            assert len(shown(value)) <= 60
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()
