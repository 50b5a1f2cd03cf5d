"""Types whose definition is given as a text."""

from __future__ import annotations

from io import BytesIO

import pytest

from rosmini import Graph
from rosmini.core.errors import DefinitionError, TypeMismatch
from rosmini.msgs import define_message, define_service, message_class


def test_the_text_of_a_file_gives_the_type_of_the_file() -> None:
    real = message_class("geometry_msgs/PoseStamped")
    ours = define_message("geometry_msgs/PoseStamped", real._spec.text)
    assert ours is not real
    assert (ours._type, ours._md5sum, ours._full_text) == (real._type, real._md5sum, real._full_text)
    message, buffer = ours(), BytesIO()
    message.pose.position.x = 2.5
    message.serialize(buffer)
    assert real().deserialize(buffer.getvalue()).pose.position.x == 2.5


def test_two_versions_of_a_type_do_not_connect() -> None:
    old, new = (define_message("my_robot/Battery", text) for text in ("float32 volts", "float32 volts\nbool full"))
    with Graph() as graph:
        graph.node("robot").publisher("battery", new)
        graph.node("laptop").subscriber("battery", old, print)
        with pytest.raises(TypeMismatch, match="bool full"):
            graph.run(0.1)


def test_a_service_is_offered_and_called() -> None:
    half = define_service("my_robot/Half", "int32 whole\n---\nfloat64 half")
    assert (half._type, half._request_class._type) == ("my_robot/Half", "my_robot/HalfRequest")
    with Graph() as graph:
        graph.node("server").service("half", half, lambda request: request.whole / 2)
        assert graph.node("client").service_client("half", half)(5).half == 2.5


def test_what_is_wrong_is_named() -> None:
    with pytest.raises(DefinitionError, match="int33"):
        define_message("my_robot/Wrong", "int32 a\nint33 B=1")
    with pytest.raises(DefinitionError, match=r"^2: .*did you mean float32"):
        define_message("my_robot/Wrong", "int32 a\nflaot32 b")
    with pytest.raises(DefinitionError, match="did you mean Point"):
        define_message("my_robot/Wrong", "geometry_msgs/Pont a")
    with pytest.raises(DefinitionError, match="---"):
        define_service("my_robot/Wrong", "int32 a")
