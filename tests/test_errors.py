"""The error tree: relatives that scripts rely on, and the texts."""

import pickle

import pytest

from rosmini import errors
from rosmini.errors import DefinitionError, ParameterNotSet, RosminiError, nearest


def test_every_error_is_a_rosmini_error() -> None:
    classes = [getattr(errors, name) for name in errors.__all__ if name != "nearest"]
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
    assert (
        str(ParameterNotSet("parameter [/a] is not set:\ntry this")) == "parameter [/a] is not set:\ntry this"
    )


def test_time_moved_backwards_keeps_the_amount() -> None:
    assert errors.ROSTimeMovedBackwardsException(1.5).time == 1.5


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
