"""What a graph as a whole offers beside its nodes."""

from __future__ import annotations

import gc
import threading
import weakref
from typing import Any

import numpy as np
import pytest

from rosmini.core.actionlib import SimpleActionClient, SimpleActionServer
from rosmini.core.errors import RosminiError, TransportInitError
from rosmini.core.graph import Graph, Node, Publisher
from rosmini.core.time import Time
from rosmini.msgs.actionlib_tutorials.msg import FibonacciAction
from rosmini.msgs.std_msgs.msg import String
from rosmini.msgs.std_srvs.srv import Trigger
from rosmini.ros.scripts import run_source


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


def used(heard: list[str]) -> tuple[Graph, Node, Publisher]:
    """Return a graph with something of everything in it, which has run for a little more than a second."""
    graph = Graph()
    server, talker = graph.node("server"), graph.node("talker")
    server.subscriber("chatter", String, lambda message: heard.append(f"{server.name} {message.data}"))
    server.service("trigger", Trigger, lambda _: (True, server.name))
    SimpleActionServer(server, "count", FibonacciAction, lambda _: None)
    publisher = talker.publisher("chatter", String, latch=True)
    talker.timer(0.25, lambda _: publisher.publish("tick"))
    assert talker.service_client("trigger", Trigger, persistent=True)().message == "/server"
    talker.run(lambda: talker.sleep(0.5))
    assert SimpleActionClient(talker, "count", FibonacciAction).wait_for_server(5.0)
    graph.run(1.1)
    return graph, talker, publisher


def test_graphs_that_were_driven_and_dropped_are_collected() -> None:
    """Whoever drops one whose own code still blocks has to shut it down."""
    heard: list[str] = []
    alive: list[weakref.ref[Any]] = []
    threads = set(threading.enumerate())
    for _ in range(100):
        graph, _, _ = used(heard)
        alive += map(weakref.ref, [graph, graph.scheduler, *graph.nodes.values(), *graph.scheduler._idle])
    del graph, _
    gc.collect()
    assert len(heard) == 400
    assert len(alive) >= 500
    assert [each for each in alive if each() is not None] == []
    assert set(threading.enumerate()) <= threads


def test_whoever_holds_a_publisher_holds_its_graph() -> None:
    heard: list[str] = []
    publisher = used(heard)[2]
    gc.collect()
    heard.clear()
    publisher.publish("still here")
    publisher.node.graph.run(1.1)
    assert heard == ["/server still here", *["/server tick"] * 4]
