"""Parameters as a node sees them."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from rosmini.core.errors import ParameterError, ParameterNotSet
from rosmini.core.names import Remappings

if TYPE_CHECKING:
    from rosmini.core.graph import Graph


def test_names_are_resolved_in_the_nodes_namespace(simulated: Graph) -> None:
    node = simulated.node("node", namespace="/robot1", remappings={"speed": "velocity"})
    node.set_param("rate", 1)
    node.set_param("~rate", 2)
    node.set_param("/rate", 3)
    node.set_param("speed", 4)
    assert {name: node.get_param(name) for name in ("/robot1/rate", "/robot1/node/rate", "/rate")} == {
        "/robot1/rate": 1,
        "/robot1/node/rate": 2,
        "/rate": 3,
    }
    assert node.get_param("/robot1/velocity") == 4


def test_private_parameters_come_from_the_command_line(simulated: Graph) -> None:
    remappings = Remappings.from_argv(["_rate:=10", "_frame:=base_link", "_gains:=[1, 2.5]", "__name:=other"])
    node = simulated.node("node", remappings=remappings)
    assert node.name == "/other"
    assert node.get_param("~rate") == 10
    assert simulated.node("x").get_param("/other/frame") == "base_link"
    assert node.get_param("~gains") == [1, 2.5]


# -- not set -----------------------------------------------------------------------------------------------------


def test_a_default_is_taken_only_when_nothing_is_set(simulated: Graph) -> None:
    node = simulated.node("node")
    assert node.get_param("p", 5) == 5
    assert node.get_param("p", None) is None
    node.set_param("p", False)
    assert node.get_param("p", 5) is False


def test_a_parameter_that_is_not_set_names_the_nearest(simulated: Graph) -> None:
    node = simulated.node("node")
    node.set_param("/max_speed", 1.0)
    with pytest.raises(ParameterNotSet, match=r"parameter /max_sped is not set .*did you mean /max_speed\?"):
        node.get_param("max_sped")
    with pytest.raises(KeyError, match="/nothing is not set"):
        node.delete_param("nothing")


def test_a_parameter_that_is_not_set_names_the_namespaces_that_have_it(simulated: Graph) -> None:
    node = simulated.node("node", namespace="/robot1")
    node.set_param("/robot2/max_speed", 1.0)
    with pytest.raises(ParameterNotSet) as caught:
        node.get_param("~max_speed")
    for name in ("/robot1/node/max_speed", "'~max_speed'", "/robot2/max_speed"):
        assert name in str(caught.value)


# -- types -------------------------------------------------------------------------------------------------------


def test_an_expected_type_is_checked(simulated: Graph) -> None:
    node = simulated.node("node")
    node.set_param("rate", 10)
    node.set_param("name", "burger")
    node.set_param("on", True)
    node.set_param("nan", float("nan"))
    assert node.get_param("rate", expect=int) == 10
    as_float = node.get_param("rate", expect=float)
    assert (as_float, type(as_float)) == (10.0, float)
    assert node.get_param("name", expect=(int, str)) == "burger"
    with pytest.raises(ParameterError, match="parameter /name is the str 'burger', and a float is needed"):
        node.get_param("name", expect=float)
    with pytest.raises(ParameterError, match="parameter /on is the bool True, and an int is needed"):
        node.get_param("on", expect=int)
    with pytest.raises(ParameterError, match="not a number"):
        node.get_param("nan", expect=float)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "parameter /p: a NoneType cannot be stored"),
        ({"a": [1, {"b": object}]}, r"parameter /p/a\[1\]/b: a type cannot be stored"),
        ({"a": {1: 2}}, "parameter /p/a: the key 1 is not a string"),
        ([2**31], r"parameter /p\[0\]: 2147483648 does not fit into the 32 bits"),
        (1j, "complex"),
    ],
)
def test_a_value_that_ros_cannot_hold_is_named_with_its_place(simulated: Graph, value: Any, text: str) -> None:
    node = simulated.node("node")
    with pytest.raises(ParameterError, match=text) as caught:
        node.set_param("p", value)
    expected = OverflowError if "does not fit" in text else TypeError
    assert isinstance(caught.value, expected)  # what xmlrpc raises in rospy
    assert not node.has_param("p")


def test_values_of_numpy_and_of_enumerations_are_stored_as_plain_ones(simulated: Graph) -> None:
    class Mode(str, enum.Enum):  # noqa: UP042 - the kind whose str() is not its value
        FAST = "fast"

    node = simulated.node("node")
    node.set_param("p", {"speed": np.float64(0.5), "poses": np.arange(3), "on": np.bool_(True), "mode": Mode.FAST})
    stored = node.get_param("p")
    assert stored == {"speed": 0.5, "poses": [0, 1, 2], "on": True, "mode": "fast"}
    assert [type(value) for value in stored.values()] == [float, list, bool, str]


def test_a_parameters_name_may_have_characters_that_a_topics_may_not(graph: Graph) -> None:
    node = graph.node("node")
    node.set_param("~my-gain", 2.5)
    assert node.get_param("/node/my-gain") == 2.5
    assert graph.node("other").get_param("node/my-gain") == 2.5
