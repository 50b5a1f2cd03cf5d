"""Parameters that are declared once, and read from a node's private namespace."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from rosmini.errors import ParameterError
from rosmini.graph import Graph
from rosmini.sim.parameters import Parameters, parameter
from rosmini.sim.simulator import SimulatorParameters


@dataclass(frozen=True)
class Settings(Parameters):
    allowed = ("tf_prefix",)

    rate: float = parameter(10.0, "how often to look", unit="Hz", minimum=0.5, maximum=100.0)
    count: int = parameter(3, "how many", minimum=1)
    label: str | None = parameter(None, "what to write on it")
    loud: bool = parameter(False, "make a noise")


@pytest.fixture
def node():
    with Graph() as graph:
        yield graph.node("worker")


def test_without_anything_set_the_defaults_hold(node):
    assert Settings.read(node) == Settings(10.0, 3, None, False)


def test_what_is_set_is_read_and_an_int_is_a_float(node):
    node.set_param("~rate", 20)
    node.set_param("~label", "left")
    node.set_param("~loud", True)
    settings = Settings.read(node)
    assert settings == Settings(20.0, 3, "left", True)
    assert isinstance(settings.rate, float)


def test_what_is_given_comes_before_what_is_set(node):
    node.set_param("~count", 5)
    assert Settings.read(node, count=7, label=None).count == 7


def test_parameters_of_other_nodes_do_not_matter(node):
    node.set_param("/rate", "fast")
    node.set_param("/other/rat", 1)
    node.set_param("~tf_prefix", "robot1")
    assert Settings.read(node) == Settings()


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("~rat", 1.0, r"/worker/rat.*no parameter ~rat; did you mean ~rate\?"),
        ("~xyz", 1.0, r"no parameter ~xyz; its parameters are ~rate, ~count, ~label, ~loud"),
        ("~rate", "fast", r"/worker/rate.*'fast'.*a float is needed"),
        ("~rate", float("nan"), r"/worker/rate is not a number"),
        ("~rate", 0.1, r"/worker/rate \(how often to look\) is 0.1; .* at least 0.5 and at most 100.0 Hz"),
        ("~count", 0, r"at least 1"),
        ("~count", 2.5, r"an int is needed"),
        ("~loud", 1, r"a bool is needed"),
        ("~label", 4, r"a str is needed"),
    ],
)
def test_what_is_wrong_is_named(node, name, value, message):
    node.set_param(name, value)
    with pytest.raises(ParameterError, match=message):
        Settings.read(node)


def test_after_a_wrong_name_the_next_attempt_is_clean(node):
    node.set_param("~rat", 1.0)
    node.set_param("~rate", 2.0)
    with pytest.raises(ParameterError):
        Settings.read(node)
    assert Settings.read(node).rate == 2.0


def test_the_table_says_all():
    assert Settings.table() == [
        ("~rate", "float", "10.0", "0.5 ... 100.0", "Hz", "how often to look"),
        ("~count", "int", "3", "1 ...", "", "how many"),
        ("~label", "str", "", "", "", "what to write on it"),
        ("~loud", "bool", "False", "", "", "make a noise"),
    ]


def test_every_parameter_of_the_simulator_has_a_meaning():
    rows = SimulatorParameters.table()
    assert [row[0] for row in rows][:2] == ["~world", "~model"]
    assert all(row[5] for row in rows)
