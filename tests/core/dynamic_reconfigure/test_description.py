"""Descriptions: from the dictionaries of .cfg modules and from typed parameters, and as messages."""

from __future__ import annotations

import ast
import copy
import math
from dataclasses import dataclass
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.dynamic_reconfigure import Config, Description, DynamicReconfigureParameterException
from rosmini.core.dynamic_reconfigure.encoding import (
    decode_description,
    decode_values,
    encode_description,
    encode_values,
)
from rosmini.core.parameters import Parameters, parameter

from .conftest import TREE, number


@dataclass(frozen=True)
class Inner(Parameters):
    depth: int = parameter(1, "how deep")


@dataclass(frozen=True)
class Settings(Parameters):
    rate: float = parameter(10.0, "how often to look", unit="Hz", minimum=0, level=1)
    name: str = parameter("laser", "whose it is")
    window: int = parameter(5, "how many", minimum=1, maximum=9, level=2, group="Filter")
    mode: str = parameter("slow", "how to look", choices=("slow", "fast"))
    inner: Inner = parameter(Inner(), "read when the node starts")
    frames: tuple[str, ...] = parameter((), "read when the node starts")


def test_the_dictionary_of_a_cfg_module():
    made = Description.of(TREE)
    assert [one.name for one in made.parameters] == ["gain", "mode", "window", "on", "depth"]
    assert [(one.name, one.id, one.parent, one.state) for one in made.groups] == [
        ("Default", 0, 0, True),
        ("Filter", 1, 0, False),
        ("Deep", 2, 1, True),
    ]
    assert made.defaults == {"gain": 1.5, "mode": "slow", "window": 5, "on": False, "depth": 0.0}
    assert (made["depth"].min, made["depth"].max) == (-1.0, math.inf)
    assert (made["on"].min, made["on"].max) == (False, True)
    assert Description.of(made) is made


def test_a_module_may_have_changed_its_tables():
    module = SimpleNamespace(config_description=TREE, defaults={"gain": 3}, min={"window": 2}, max={})
    made = Description.of(module)
    assert (made["gain"].default, made["window"].min, made["window"].max) == (3.0, 2, 99)


def test_typed_parameters():
    made = Description.of(Settings)
    assert [(one.name, one.type, one.level, one.default) for one in made.parameters] == [
        ("rate", "double", 1, 10.0),
        ("name", "str", 0, "laser"),
        ("mode", "str", 0, "slow"),
        ("window", "int", 2, 5),
    ]
    assert [one["name"] for one in ast.literal_eval(made["mode"].edit_method)["enum"]] == ["slow", "fast"]
    assert made["rate"].edit_method == ""
    assert made["rate"].description == "how often to look [Hz]"
    assert (made["rate"].min, made["rate"].max) == (0.0, math.inf)
    assert [one.name for one in made.group("Filter").parameters] == ["window"]


def test_a_typed_parameter_that_may_be_missing_cannot_be_reconfigured():
    @dataclass(frozen=True)
    class Loose(Parameters):
        path: str | None = parameter(None, "a file")

    with pytest.raises(DynamicReconfigureParameterException, match=r"Loose\.path may be str \| None"):
        Description.of(Loose)


@pytest.mark.parametrize(
    ("one", "problem"),
    [
        (number("x", "float"), r"type 'float'; .*double|types are"),
        (number("x", default="a"), "has the type double and cannot be set to the str 'a'"),
        (number("x", default=5.0, max=1.0), "default 5.0 is not in its range, -inf ... 1.0"),
        (number("x", "int", default=2**31), "32 bits"),
        (number("window"), "the parameter window more than once"),
        ({"type": "int"}, "TypeError"),
    ],
)
def test_wrong_parameters(one, problem):
    tree = copy.deepcopy(TREE)
    tree["parameters"].append(one)
    with pytest.raises(DynamicReconfigureParameterException, match=problem):
        Description.of(tree)


def test_what_describes_nothing():
    for source in ("gain", {"name": "Default"}, SimpleNamespace(config_description=3), int):
        with pytest.raises(DynamicReconfigureParameterException, match=r"describe|description"):
            Description.of(source)


def test_names_that_are_not_there():
    made = Description.of(TREE)
    with pytest.raises(DynamicReconfigureParameterException, match="'gian'; did you mean gain"):
        made["gian"]
    with pytest.raises(DynamicReconfigureParameterException, match="the groups are Default, Filter, Deep"):
        made.group("x")


KINDS = st.sampled_from(["double", "int", "bool", "str"])
NAMES = st.lists(st.from_regex(r"[a-z]{1,8}", fullmatch=True), unique=True, max_size=8)


@st.composite
def descriptions(draw):
    """Descriptions with random parameters, each in one of three groups."""
    tree = {"name": "Default", "parameters": [], "groups": []}
    inner = {"name": "A", "parameters": [], "groups": [{"name": "B", "parameters": [], "groups": []}]}
    tree["groups"].append(inner)
    for name in draw(NAMES):
        kind = draw(KINDS)
        one = number(name, kind, level=draw(st.integers(0, 255)))
        if kind in ("double", "int"):
            of = st.integers(-1000, 1000) if kind == "int" else st.floats(-1e6, 1e6)
            one["min"], one["default"], one["max"] = sorted(draw(st.tuples(of, of, of)))
        draw(st.sampled_from([tree, inner, inner["groups"][0]]))["parameters"].append(one)
    return Description.of(tree)


@given(descriptions())
def test_descriptions_come_through_messages(made):
    back = decode_description(encode_description(made))
    assert back.parameters == made.parameters
    assert [(one.name, one.id, one.parent) for one in back.groups] == [
        (one.name, one.id, one.parent) for one in made.groups
    ]
    values, states = decode_values(encode_values(made, made.defaults, {"A": False}))
    assert values == made.defaults
    assert states == {"A": False}


@given(descriptions(), st.floats(allow_nan=False))
def test_clamping_stays_in_the_range_and_changes_nothing_in_it(made, value):
    for one in made.parameters:
        if one.type == "double":
            limited = one.clamp(value)
            assert one.min <= limited <= one.max
            assert limited == value or not one.min <= value <= one.max


def test_a_configuration_has_items_and_attributes():
    config = Config(gain=2)
    config.gain = 3
    assert config["gain"] == config.copy().gain == 3
    with pytest.raises(AttributeError, match="gian"):
        config.gian


def test_a_message_that_describes_too_little():
    message = encode_description(Description.of(TREE))
    message.dflt.doubles = []
    with pytest.raises(DynamicReconfigureParameterException, match="no default or no range"):
        decode_description(message)
    message.groups = message.groups[1:]
    with pytest.raises(DynamicReconfigureParameterException, match="no group 0"):
        decode_description(message)
