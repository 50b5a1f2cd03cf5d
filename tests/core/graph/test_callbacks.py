"""A callback that raises: where it is told, what is told, and that everything else goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import CallbackError
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.std_msgs.msg import Int32, String

from .conftest import settle, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph, Publisher


def failing(graph: Graph, heard: list[Any]) -> Publisher:
    """A node whose callback fails on zero, and one that hears the same and does not."""

    def on_number(message: Any) -> None:
        heard.append(100 // message.data)

    graph.node("fails").subscriber("n", Int32, on_number)
    graph.node("works").subscriber("n", Int32, lambda message: heard.append(("works", message.data)))
    publisher = graph.node("talker").publisher("n", Int32)
    publisher.wait_for_subscribers(2)
    return publisher


TEXT = (
    "failing.<locals>.on_number".rpartition("<locals>.")[2] + " of /fails, called for /n, raised ZeroDivisionError",
    "test_callbacks.py, line ",
    "in on_number: heard.append(100 // message.data)",
    "The message (std_msgs/Int32):",
    "data: 0",
)


def test_in_a_strict_graph_it_is_raised_where_the_graph_is_driven(graph: Graph) -> None:
    heard: list[Any] = []
    publisher = failing(graph, heard)
    publisher.publish(0)
    with pytest.raises(CallbackError) as caught:
        until(graph, lambda: False)
    for text in TEXT:
        assert text in str(caught.value)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    until(graph, lambda: ("works", 0) in heard)
    publisher.publish(5)
    until(graph, lambda: len(heard) == 3)
    assert 20 in heard, "the connection survives"


def test_in_a_lenient_graph_it_is_logged(lenient: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    heard: list[Any] = []
    publisher = failing(lenient, heard)
    publisher.publish(0)
    publisher.publish(5)
    until(lenient, lambda: len(heard) == 3)
    said = capsys.readouterr().err
    for text in TEXT:
        assert text in said
    assert len([line for line in said.splitlines() if "[ERROR]" in line and "Will keep trying" not in line]) == 1


def test_none_of_several_errors_is_lost(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    def bad(name: str) -> None:
        raise ValueError(f"{name} is broken")

    node = graph.node("node")
    for name in ("first", "second", "third"):
        node.subscriber("t", String, lambda _, name=name: bad(name))
    publisher = graph.node("talker").publisher("t", String)
    publisher.wait_for_subscribers()
    publisher.publish("x")
    told = ""
    while not all(f"{name} is broken" in told for name in ("first", "second", "third")):
        before = told
        try:
            settle(graph)
        except CallbackError as error:
            told += str(error)
        told += capsys.readouterr().err
        assert told != before, "an error was lost"


def test_a_long_message_is_shown_in_part(graph: Graph) -> None:
    def bad(_: Any) -> None:
        raise ValueError("broken")

    graph.node("node").subscriber("path", Twist, bad)
    from rosmini.msgs.geometry_msgs.msg import PoseStamped
    from rosmini.msgs.nav_msgs.msg import Path

    graph.node("other").subscriber("long", Path, bad)
    publisher = graph.node("talker").publisher("long", Path)
    publisher.wait_for_subscribers()
    publisher.publish(Path(poses=[PoseStamped()] * 50))
    with pytest.raises(CallbackError, match=r"\.\.\. and \d+ more lines"):
        until(graph, lambda: False)


def test_errors_in_timers_and_connection_callbacks_say_where(graph: Graph) -> None:
    def bad(*_: Any) -> None:
        raise ValueError("broken")

    node = graph.node("node")
    timer = node.timer(1.0, bad)
    ticks: list[Any] = []
    other = node.timer(0.5, ticks.append)
    with pytest.raises(
        CallbackError, match=r"bad of /node, called for a timer, which ends with it, raised ValueError: broken"
    ):
        until(graph, lambda: False)
    assert not timer.is_alive()  # as the thread of a rospy.Timer dies; the node and its other timers go on
    ticks.clear()
    until(graph, lambda: len(ticks) == 4)
    other.shutdown()
    node.publisher("t", String, on_connect=bad)
    graph.node("other").subscriber("t", String)
    with pytest.raises(CallbackError, match="called for connection callback of /t"):
        until(graph, lambda: False)


def test_an_error_is_raised_at_any_call_that_blocks(graph: Graph) -> None:
    publisher = failing(graph, [])
    publisher.publish(0)
    with pytest.raises(CallbackError, match="ZeroDivisionError"):
        graph.nodes["/talker"].sleep(2_000.0)  # it does not take that long


def test_the_main_program_of_a_node_that_fails_is_told_as_it_is(graph: Graph) -> None:
    def main() -> None:
        raise KeyError("oops")

    graph.node("node").run(main)
    with pytest.raises(KeyError, match="oops"):
        until(graph, lambda: False)


def test_a_callback_with_the_wrong_number_of_arguments_is_told_too(graph: Graph) -> None:
    graph.node("node").subscriber("t", String, lambda: None)
    publisher = graph.node("talker").publisher("t", String)
    publisher.wait_for_subscribers()
    publisher.publish("x")
    with pytest.raises(CallbackError, match="takes 0 positional arguments but 1 was given"):
        until(graph, lambda: False)
