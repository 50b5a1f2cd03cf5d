"""What a graph as a whole offers beside its nodes."""

from __future__ import annotations

import gc
import weakref
from typing import Any

import numpy as np
import pytest

from rosmini.errors import RosminiError, TransportInitError
from rosmini.graph import Graph
from rosmini.msgs.std_msgs.msg import String
from rosmini.scripts import run_source
from rosmini.time import Time


def test_a_graph_shows_itself() -> None:
    graph = Graph()
    graph.node("talker").publisher("chatter", String)
    graph.node("listener").subscriber("chatter", String)
    assert "/talker -> /chatter [std_msgs/String] -> /listener" in repr(graph.show())
    assert "talker" in graph.show(title="Two nodes").alt


@pytest.mark.parametrize("duration", [-1, -0.1, "5", float("nan"), float("inf"), True, [1], Time(1)])
def test_a_duration_that_is_none_is_a_clear_error(duration: Any) -> None:
    with pytest.raises(RosminiError, match="a run's duration is a number of seconds, zero or more, not"):
        Graph().run(duration)
    with pytest.raises(RosminiError, match="a run's duration is a number of seconds"):
        run_source("print(1)", duration=duration)


def test_a_run_of_no_time_does_what_is_due() -> None:
    graph, heard = Graph(), []
    graph.scheduler.call_soon(lambda: heard.append(1))
    assert graph.run(0).reason == "time"
    assert heard == [1]
    assert graph.run(np.float32(0.5)).now == 1000.5
    assert graph.run(None).reason == "drained"


def test_a_registered_node_that_does_not_answer_is_unreachable() -> None:
    graph = Graph()
    graph.node("talker").publisher("chatter", String)
    graph.master.registerPublisher("/ghost", "/chatter", "std_msgs/String", "http://nobody:1/")
    assert graph.unreachable == ("/ghost",)
    assert "/ghost does not answer" in repr(graph.show(mode="nodes_topics_all", hide=("debug",)))


def test_a_refusal_for_another_reason_than_the_type_says_who_and_why() -> None:
    graph = Graph()
    talker, listener = graph.node("talker"), graph.node("listener")
    talker.publisher("chatter", String)
    listener.subscriber("chatter", String)
    refused = [0, "no supported protocol implementations", []]
    talker.slave_call = lambda *arguments: refused  # type: ignore[method-assign]
    with pytest.raises(
        TransportInitError, match=r"/talker refused the connection of /listener to /chatter: no supported"
    ):
        graph.run(0.1)


def test_a_publisher_that_left_before_the_connection_was_made_is_no_error() -> None:
    graph = Graph()
    talker, listener = graph.node("talker"), graph.node("listener")
    publisher = talker.publisher("chatter", String)
    subscriber = listener.subscriber("chatter", String)
    publisher.unregister()
    assert graph.run(0.1).reason == "time"
    assert subscriber.num_connections() == 0


def test_a_graph_that_was_driven_and_dropped_is_collected() -> None:
    """Its idle greenlets hold nothing; one whose timers or scripts are parked has to be shut down."""
    heard: list[str] = []
    alive: list[weakref.ref[Any]] = []
    for _ in range(10):
        graph = Graph()
        graph.node("listener").subscriber("chatter", String, lambda message: heard.append(message.data))
        publisher = graph.node("talker").publisher("chatter", String)
        publisher.wait_for_subscribers()
        publisher.publish("x")
        graph.run(1.0)
        alive.append(weakref.ref(graph.scheduler))
    del graph, publisher
    gc.collect()
    assert heard == ["x"] * 10
    assert [each for each in alive if each() is not None] == []
