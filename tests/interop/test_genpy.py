"""Our messages beside the real genpy's: bytes, md5 sums, full texts, printed form, types on receipt, errors.

Skipped where there is no genpy, unless ROSMINI_REQUIRE_ROS is set.
"""

from __future__ import annotations

import io
import os
import pickle
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rosmini.core.errors import SerializationError
from rosmini.core.packages import PackageIndex, assets_dir
from rosmini.core.time import Duration, Time, TVal
from rosmini.msgs.definition import INTEGER_RANGES
from rosmini.msgs.message import Message
from rosmini.msgs.registry import Registry, registry
from rosmini.msgs.sources import PackageSource

from ..processes import run
from .conftest import SYSTEM_PYTHON, need_ros

PEER = Path(__file__).with_name("genpy_peer.py")
MESSAGES_EACH = 3
WORDS = [
    "", "base_link", "a b: 'c'", 'say "hi"\\', "größe", "two\nlines\t", "x" * 90, "word " * 30, "\x07bell", "yes",
    "1.5", "- a",
]  # fmt: skip
FLOATS = [
    0.0, -0.0, 1.5, -2.25, 1e-300, 3.0e38, float("inf"), float("-inf"), float("nan"), 0.1, 1e16, 123456789.0,
]  # fmt: skip

ODD_DEFINITIONS = {
    "Nothing": "# only a comment, naïve\n",
    "Scalars": "bool a\nbool b\nint8 c\nbyte d\nchar e\nuint64 f\nint64 g\nfloat32 h\nfloat64 i\nstring j\ntime "
    "k\nduration l\n",
    "Variable": "bool[] a\nbyte[] b\nchar[] c\nuint8[] d\nint16[] e\nuint32[] f\nfloat32[] g\nstring[] h\ntime[] i\n"
    "duration[] j\nNothing[] k\nScalars[] l\n",
    "Fixed": "bool[2] a\nbyte[3] b\nchar[3] c\nuint8[4] d\nint64[2] e\nfloat64[3] f\nstring[2] g\ntime[2] h\n"
    "duration[1] i\nNothing[2] j\nScalars[2] k\nVariable[2] l\n",
    "Words": "int32 from\nstring self\nfloat64 lambda\nint8 in=3\nHeader header\n",
    "Constants": "  int32   SPACED  =  -5   # a comment\nstring TEXT= a # b = c  \nstring SPACE = x\nbool "
    "YES=True\nfloat32 F=1.50\n"
    "uint8 small_case=255\nchar C=65\nbyte B=-3\nfloat64 x # y = 3\nstring EMPTY=\n  float64    z#tight\n",
    "Stamped": "Header header\nConstants[] constants\nFixed fixed\nstd_msgs/Header other\nWords words\n",
    "Late": "int8 a\nHeader header\n",
}


def all_types() -> list[str]:
    reg = registry()
    found = []
    for package in reg.source.packages():
        found += [f"{package}/{name}" for name in reg.messages(package)]
        found += [f"{package}/{name}{half}" for name in reg.services(package) for half in ("Request", "Response")]
    return found


def random_plain(rng: random.Random, cls: type[Message]) -> dict[str, Any]:
    plain: dict[str, Any] = {}
    for field in cls._spec.fields:
        if field.size is None:
            plain[field.name] = random_value(rng, cls, field.base)
            continue
        count = field.size if field.size >= 0 else rng.choice([0, 1, 2, 5])
        values = [random_value(rng, cls, field.base) for _ in range(count)]
        plain[field.name] = bytes(values) if field.base in ("uint8", "char") else values
    return plain


def random_value(rng: random.Random, cls: type[Message], base: str) -> Any:
    if base in INTEGER_RANGES:
        lower, upper = INTEGER_RANGES[base]
        return rng.choice([lower, upper, 0, 1, rng.randint(lower, upper)])
    if base == "float32":
        return rng.choice([*(x for x in FLOATS if x != 1e-300), rng.uniform(-10, 10)])
    if base == "float64":
        return rng.choice([*FLOATS, rng.uniform(-10, 10)])
    if base == "bool":
        return rng.random() < 0.5
    if base == "string":
        return rng.choice(WORDS)
    if base == "time":
        return (rng.choice([0, 1, 2**32 - 1]), rng.choice([0, 5, 999_999_999]))
    if base == "duration":
        return (rng.choice([-(2**31), -1, 0, 7, 2**31 - 1]), rng.choice([0, 5, 999_999_999]))
    return random_plain(rng, cls._nested[base])


def filled(cls: type[Message], plain: dict[str, Any]) -> Any:
    return cls(**{field.name: our_value(cls, field.base, plain[field.name]) for field in cls._spec.fields})


def our_value(cls: type[Message], base: str, plain: Any) -> Any:
    if isinstance(plain, list):
        return [our_value(cls, base, element) for element in plain]
    if base in ("time", "duration"):
        return (Time if base == "time" else Duration)(*plain)
    return filled(cls._nested[base], plain) if isinstance(plain, dict) else plain


def describe(thing: Any) -> Any:
    if isinstance(thing, Message):
        return (thing._type, [(name, describe(getattr(thing, name))) for name in type(thing).__slots__])
    if isinstance(thing, TVal):
        return (type(thing).__name__, thing.secs, thing.nsecs)
    if isinstance(thing, (list, tuple)):
        return (type(thing).__name__, [describe(element) for element in thing])
    if isinstance(thing, np.ndarray):
        return ("ndarray", str(thing.dtype), repr(thing.tolist()))
    return (type(thing).__name__, repr(thing))


def ask_genpy(jobs: list[Any]) -> list[Any]:
    # genpy writes modules in the encoding of the locale and reads them as UTF-8
    environment = {**os.environ, "PYTHONPATH": "", "PYTHONDONTWRITEBYTECODE": "1", "PYTHONUTF8": "1"}
    job = pickle.dumps(jobs, protocol=4)
    done = run([SYSTEM_PYTHON, PEER], stdin=job, env=environment, encoding=None, check=True)
    answers: list[Any] = pickle.loads(done.stdout)
    return answers


@pytest.fixture(scope="module")
def genpy() -> None:
    need_ros(modules="genpy.dynamic, numpy")


@pytest.fixture(scope="module")
def odd_types(tmp_path_factory: pytest.TempPathFactory) -> Registry:
    """A package of types that use every corner of the message language."""
    workspace = tmp_path_factory.mktemp("workspace")
    folder = workspace / "odd_msgs" / "msg"
    folder.mkdir(parents=True)
    (workspace / "odd_msgs" / "package.xml").write_text(
        '<package format="2"><name>odd_msgs</name><version>0.0.1</version><description>Odd.</description>'
        '<maintainer email="a@example.com">A</maintainer><license>Apache-2.0</license></package>',
        encoding="utf-8",
    )
    for name, text in ODD_DEFINITIONS.items():
        (folder / f"{name}.msg").write_text(text, encoding="utf-8")
    return Registry(PackageSource(PackageIndex([workspace, assets_dir() / "ros"])))


@pytest.fixture(scope="module")
def compared(genpy: None, odd_types: Registry) -> list[tuple[type[Any], list[Any], dict[str, Any]]]:
    """For each type: our class, our messages, and what genpy says about the same."""
    rng = random.Random("rosmini")
    jobs, ours = [], []
    classes = [registry().message_class(name) for name in all_types()]
    classes += [odd_types.message_class(f"odd_msgs/{name}") for name in ODD_DEFINITIONS]
    for cls in classes:
        name = cls._type
        plain = [random_plain(rng, cls) for _ in range(MESSAGES_EACH)]
        jobs.append((name, cls._full_text, plain))
        ours.append((cls, [filled(cls, one) for one in plain]))
    return [(cls, messages, theirs) for (cls, messages), theirs in zip(ours, ask_genpy(jobs), strict=True)]


def test_md5_sums_slots_and_constants(compared: Any) -> None:
    for cls, _, theirs in compared:
        assert cls._md5sum == theirs["md5"], cls._type
        assert theirs["installed_md5"] in (None, cls._md5sum), cls._type
        assert cls._has_header == theirs["has_header"], cls._type
        assert (cls.__slots__, cls._slot_types) == theirs["slots"], cls._type
        constants = {constant.name: repr(getattr(cls, constant.name)) for constant in cls._spec.constants}
        assert constants == theirs["constants"], cls._type


def test_full_text_is_what_genpy_makes_of_it(compared: Any) -> None:
    for cls, _, theirs in compared:
        assert cls._full_text == theirs["full_text"], cls._type


def test_default_values(compared: Any) -> None:
    for cls, _, theirs in compared:
        assert describe(cls()) == theirs["default"], cls._type


def test_bytes_on_the_wire(compared: Any) -> None:
    for cls, messages, theirs in compared:
        for message, other in zip(messages, theirs["messages"], strict=True):
            assert cls._encode(message) == other["data"], message
            assert cls._encode(cls._freeze(message)) == other["data"], message
            buffer = io.BytesIO()
            message.serialize(buffer)
            assert buffer.getvalue() == other["data"], message


def test_what_a_subscriber_receives(compared: Any) -> None:
    for cls, messages, theirs in compared:
        for message, other in zip(messages, theirs["messages"], strict=True):
            assert describe(cls._thaw(cls._freeze(message))) == other["received"], cls._type
            assert describe(cls._thaw(cls._decode(other["data"]))) == other["received"], cls._type
            assert describe(cls().deserialize(other["data"])) == other["received"], cls._type
            if other["received_numpy"] is not None:
                assert describe(cls().deserialize_numpy(other["data"], np)) == other["received_numpy"], cls._type


def test_printed_form(compared: Any) -> None:
    for cls, messages, theirs in compared:
        for message, other in zip(messages, theirs["messages"], strict=True):
            assert str(message) == other["text"]
            assert repr(message) == other["text"]
            assert str(cls().deserialize(other["data"])) == other["received_text"]


def test_many_types_were_compared(compared: Any) -> None:
    assert len(compared) > 300
    assert sum(theirs["installed_md5"] is not None for _, _, theirs in compared) > 130
    assert {"Fixed", "Stamped"} <= {cls.__name__ for cls, _, _ in compared}


# What stands in a field, and the words that genpy's and our error must share; None: both write the same bytes.
ATTEMPTS: list[tuple[str, str, str, str | None]] = [
    ("std_msgs/Float64", "data", "1", None), ("std_msgs/Float64", "data", "True", None),
    ("std_msgs/Float64", "data", "np.float32(1.5)", None), ("std_msgs/Float64", "data", "np.int64(3)", None),
    ("std_msgs/Float64", "data", "float('nan')", None),
    ("std_msgs/Float64", "data", "'1'", "field data must be float type"),
    ("std_msgs/Float64", "data", "None", "field data must be float type"),
    ("std_msgs/Float64", "data", "[1.0]", "field data must be float type"),
    ("std_msgs/Float32", "data", "0.1", None), ("std_msgs/Float32", "data", "float('inf')", None),
    ("std_msgs/Int8", "data", "127", None), ("std_msgs/Int8", "data", "True", None),
    ("std_msgs/Int8", "data", "np.int8(-3)", None), ("std_msgs/Int8", "data", "np.uint64(3)", None),
    ("std_msgs/Int8", "data", "128", "field data exceeds specified width [int8]"),
    ("std_msgs/Int8", "data", "-129", "field data exceeds specified width [int8]"),
    ("std_msgs/Int8", "data", "1.0", "field data must be an integer type"),
    ("std_msgs/Int8", "data", "np.float64(1)", "field data must be an integer type"),
    ("std_msgs/Int8", "data", "'1'", "field data must be an integer type"), ("std_msgs/UInt8", "data", "255", None),
    ("std_msgs/UInt8", "data", "-1", "field data must be unsigned integer type"),
    ("std_msgs/UInt8", "data", "2.0", "field data must be unsigned integer type"),
    ("std_msgs/UInt8", "data", "256", "field data exceeds specified width [uint8]"),
    ("std_msgs/Bool", "data", "True", None), ("std_msgs/Bool", "data", "1", None),
    ("std_msgs/Bool", "data", "np.uint8(0)", None), ("std_msgs/Bool", "data", "np.bool_(True)", None),
    ("std_msgs/Bool", "data", "'yes'", "field data is not a bool"),
    ("std_msgs/Bool", "data", "None", "field data is not a bool"),
    ("std_msgs/String", "data", "'gr\u00f6\u00dfe'", None), ("std_msgs/String", "data", "np.str_('text')", None),
    ("std_msgs/String", "data", "5", "field data must be of type"),
    ("std_msgs/Float64MultiArray", "data", "[1, 2.5]", None), ("std_msgs/Float64MultiArray", "data", "(1.0,)", None),
    ("std_msgs/Float64MultiArray", "data", "np.array([1.0, 2.0])", None),
    ("std_msgs/Float64MultiArray", "data", "np.array([1, 2], np.int16)", None),
    ("std_msgs/Float64MultiArray", "data", "np.array([1, 2], '>f8')", None),
    ("std_msgs/Float64MultiArray", "data", "np.arange(6.0)[::2]", None),
    ("std_msgs/Float64MultiArray", "data", "range(3)", None),
    ("std_msgs/Float64MultiArray", "data", "'ab'", "field data must be a list or tuple type"),
    ("std_msgs/Float64MultiArray", "data", "5", "field data must be a list or tuple type"),
    ("std_msgs/Float64MultiArray", "data", "None", "field data must be a list or tuple type"),
    ("std_msgs/Float64MultiArray", "data", "np.zeros((2, 2))", "field data"),
    ("std_msgs/Float64MultiArray", "data", "[1.0, 'x']", "must be float type"),
    ("std_msgs/Float32MultiArray", "data", "np.array([0.1, 0.2])", None),
    ("std_msgs/Int32MultiArray", "data", "np.array([1, -2])", None),
    ("std_msgs/Int32MultiArray", "data", "[1.5]", "must be an integer type"),
    ("std_msgs/Int32MultiArray", "data", "[2**31]", "exceeds specified width [int32]"),
    ("std_msgs/UInt8MultiArray", "data", "b'ab'", None), ("std_msgs/UInt8MultiArray", "data", "[1, 255]", None),
    ("std_msgs/UInt8MultiArray", "data", "(1, 2)", None),
    ("std_msgs/UInt8MultiArray", "data", "bytearray(b'ab')", None),
    ("std_msgs/UInt8MultiArray", "data", "[256]", "exceeds specified width [uint8]"),
    ("std_msgs/UInt8MultiArray", "data", "[-1]", "must be unsigned integer type"),
    ("std_msgs/UInt8MultiArray", "data", "5", ""), ("std_msgs/UInt8MultiArray", "data", "'ab'", ""),
    ("geometry_msgs/PoseWithCovariance", "covariance", "np.zeros(36)", None),
    ("geometry_msgs/PoseWithCovariance", "covariance", "[0.0] * 35", "35"),
    ("geometry_msgs/Twist", "angular", "'fast'", ""), ("geometry_msgs/Twist", "angular", "None", ""),
    ("std_msgs/Header", "stamp", "Duration(3, 4)", None), ("std_msgs/Header", "stamp", "3.0", ""),
    ("std_msgs/Header", "seq", "-1", "field seq must be unsigned integer type"),
    ("sensor_msgs/JointState", "name", "('a', 'b')", None), ("sensor_msgs/JointState", "name", "[1]", ""),
    ("nav_msgs/Path", "poses", "[1]", ""), ("nav_msgs/Path", "poses", "None", ""),
]  # fmt: skip

# Where we differ on purpose: (type, field, expression, what genpy does, what we do).
DIFFERENCES = [
    ("std_msgs/Float32", "data", "1e39", "OverflowError", "SerializationError"),
    ("std_msgs/String", "data", "b'bytes'", "AttributeError", "SerializationError"),
    ("std_msgs/String", "data", "chr(0xD800)", "UnicodeEncodeError", "SerializationError"),
    ("std_msgs/UInt8MultiArray", "data", "np.array([1, 2], np.uint8)", "SerializationError", "written"),
    ("sensor_msgs/JointState", "name", "'ab'", "written", "SerializationError"),
]


def try_ours(type_name: str, field: str, expression: str) -> tuple[str, Any]:
    cls = registry().message_class(type_name)
    message = cls()
    setattr(message, field, eval(expression, {"np": np, "Time": Time, "Duration": Duration}))
    results = []
    for attempt in (lambda: cls._encode(message), lambda: cls._encode(cls._freeze(message))):
        try:
            results.append(("written", attempt()))
        except SerializationError as error:
            results.append(("SerializationError", str(error)))
    assert results[0] == results[1]
    return results[0]


def ask_attempts(attempts: list[tuple[str, str, str]]) -> list[tuple[str, Any]]:
    return ask_genpy([(name, registry().message_class(name)._full_text, *rest) for name, *rest in attempts])


def test_the_same_values_are_written_or_refused(genpy: None) -> None:
    answers = ask_attempts([attempt[:3] for attempt in ATTEMPTS])
    for (*attempt, words), theirs in zip(ATTEMPTS, answers, strict=True):
        ours = try_ours(*attempt)
        if words is None:
            assert ours == theirs, attempt
            continue
        assert theirs[0] != "written", attempt
        assert ours[0] == "SerializationError", attempt
        assert words in theirs[1], attempt
        assert words in ours[1], attempt
        assert attempt[1] in ours[1], attempt


def test_the_differences_are_the_documented_ones(genpy: None) -> None:
    answers = ask_attempts([difference[:3] for difference in DIFFERENCES])
    for (*attempt, expected_theirs, expected_ours), theirs in zip(DIFFERENCES, answers, strict=True):
        assert theirs[0] == expected_theirs, (attempt, theirs)
        assert try_ours(*attempt)[0] == expected_ours, attempt
