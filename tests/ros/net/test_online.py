"""A graph that goes online: serves its Master or joins another one, tells its time, and comes back."""

from __future__ import annotations

import itertools
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest

from rosmini.core.errors import MasterUnreachable, RosminiError
from rosmini.core.graph import Graph
from rosmini.core.graph.clock import GraphClock, TopicClock
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.core.graph.master import Master
from rosmini.core.time import Time
from rosmini.msgs import message_class, service_class
from rosmini.ros.net import connect
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.master_server import MasterServer
from rosmini.ros.net.network import network_of, tcp

from ...processes import PATIENCE, free_port

String = message_class("std_msgs/String")
Trigger = service_class("std_srvs/Trigger")


@pytest.fixture
def environ() -> dict[str, str]:
    """Where the Master is to be."""
    return {"ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}"}


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph in simulated time, as in a notebook."""
    with Graph() as made:
        yield made


@pytest.fixture
def elsewhere(environ: dict[str, str]) -> Iterator[Graph]:
    """A graph as of another process, in wall time."""
    with connect(environ) as made:
        yield made


def together(*graphs: Graph, until: Callable[[], object]) -> None:
    """Drive graphs by turns, a hundredth of a second each, until a condition holds."""
    end = time.monotonic() + PATIENCE
    while not until():
        assert time.monotonic() < end, "it did not come about"
        for graph in graphs:
            graph.run(0.01)


def in_lane(graph: Graph, task: Callable[[], Any]) -> list[Any]:
    """Start a task that may block; what it returns comes into the list."""
    results: list[Any] = []
    graph.scheduler.spawn("task", lambda: results.append(task()))
    return results


class Pair:
    """A talker and a listener of one graph, which are connected in it."""

    def __init__(self, graph: Graph) -> None:
        self.heard: list[str] = []
        self.listener = graph.node("listener")
        self.listener.subscriber("chatter", String, lambda message: self.heard.append(message.data))
        self.talker = graph.node("talker")
        self.publisher = self.talker.publisher("chatter", String)
        self.talker.service("ask", Trigger, lambda _: (True, "here I am"))
        graph.run(0.1)
        (self.connection,) = self.listener.subscriptions["/chatter"].connections.values()

    def still_connected(self) -> bool:
        """Tell whether the connection in the process is the same, and the only one."""
        return list(self.listener.subscriptions["/chatter"].connections.values()) == [self.connection]


def test_a_graph_serves_its_master_and_others_talk_to_its_nodes(
    graph: Graph, elsewhere: Graph, environ: dict[str, str]
) -> None:
    pair = Pair(graph)
    before = pair.talker.uri
    graph.online(environ=environ)
    assert pair.talker.uri.startswith("http://127.0.0.1:")
    assert pair.still_connected()
    heard: list[str] = []
    node = elsewhere.node("far")
    node.subscriber("chatter", String, lambda message: heard.append(message.data))
    together(graph, elsewhere, until=lambda: pair.publisher.num_connections() == 2)
    pair.publisher.publish("to both")
    together(graph, elsewhere, until=lambda: heard == ["to both"] and pair.heard == ["to both"])
    assert pair.still_connected()
    answers = in_lane(elsewhere, lambda: node.service_client("ask", Trigger)().message)
    together(graph, elsewhere, until=lambda: answers)
    assert answers == ["here I am"]
    back = node.publisher("chatter", String)
    together(graph, elsewhere, until=lambda: back.num_connections() == 2)
    back.publish("from afar")
    together(graph, elsewhere, until=lambda: pair.heard == ["to both", "from afar"])
    graph.offline()
    assert pair.talker.uri != before  # a new one, of this process
    assert graph.master_uri == "http://localhost:11311/"
    assert pair.still_connected()
    assert pair.publisher.num_connections() == 1
    pair.publisher.publish("among us")
    graph.run(0.1)
    assert pair.heard[-1] == "among us"
    assert graph.node("asker").service_client("ask", Trigger)().message == "here I am"


def test_a_graph_joins_a_master_that_answers_and_comes_back(graph: Graph, environ: dict[str, str]) -> None:
    with Graph(simulated=False, transports=[LocalTransport, tcp()]) as home:
        assert isinstance(home.master, Master)
        where = addresses(environ)
        server = MasterServer(network_of(home).io, home.master, where, where.master[1])
        pair = Pair(graph)
        graph.ask_as("/test").ask("setParam", "/robot", {"name": "r1", "size": [1, 2.5]})
        assert graph.online(environ=environ).joined
        ask = home.ask_as("/test").ask
        assert ask("lookupNode", "/talker") == pair.talker.uri
        assert ["/chatter", ["/talker"]] in ask("getSystemState")[0]
        assert ["/ask", ["/talker"]] in ask("getSystemState")[2]
        assert ask("getParam", "/robot") == {"name": "r1", "size": [1, 2.5]}
        assert ask("lookupNode", "/rosout") == home.nodes["/rosout"].uri
        assert pair.still_connected()
        graph.offline()
        assert {name for part in ask("getSystemState") for _, names in part for name in names} == {"/rosout"}
        assert "/rosout" in graph.nodes
        assert graph.ask_as("/test").find("lookupNode", "/talker") == pair.talker.uri
        assert pair.still_connected()
        pair.publisher.publish("among us")
        graph.run(0.1)
        assert pair.heard == ["among us"]
        server.close()


def test_others_live_on_the_time_of_a_graph_that_is_simulated(
    graph: Graph, elsewhere: Graph, environ: dict[str, str]
) -> None:
    graph.online(environ=environ)
    assert graph.ask_as("/test").find("getParam", "/use_sim_time") is True
    own = graph.node("own")
    assert isinstance(own.clock, GraphClock)
    far = elsewhere.node("far")
    assert isinstance(far.clock, TopicClock)
    slept = in_lane(elsewhere, lambda: (far.sleep(1.0), far.now().to_sec())[1])
    together(graph, elsewhere, until=lambda: slept)
    assert 1001.0 <= slept[0] <= graph.now().to_sec()
    graph.offline()
    assert graph.ask_as("/test").find("getParam", "/use_sim_time") is None
    assert "/rosmini_clock" not in graph.nodes


def test_a_simulator_that_starts_replaces_the_clock(graph: Graph, elsewhere: Graph, environ: dict[str, str]) -> None:
    before = graph.node("before")
    graph.online(environ=environ)
    heard: list[float] = []
    clock = graph.clock_class
    elsewhere.node("far").subscriber("/clock", clock, lambda message: heard.append(message.clock.to_sec()))
    together(graph, elsewhere, until=lambda: heard)
    simulator = graph.node("simulator")
    publisher = simulator.publisher("/clock", clock)
    after = graph.node("after")
    simulator.timer(0.01, lambda _: publisher.publish(clock=Time.from_sec(graph.now().to_sec() - 1000)))
    together(graph, elsewhere, until=lambda: heard[-1] < 1000 and after.now() and len(heard) > 20)
    assert sum(late < early for early, late in itertools.pairwise(heard)) == 1
    assert "/rosmini_clock" not in graph.nodes
    assert after.now().to_sec() < 1000 <= before.now().to_sec()
    graph.offline()
    assert graph.ask_as("/test").find("getParam", "/use_sim_time") is True  # for the simulator


@pytest.mark.parametrize("live", [True, False])
def test_time_that_others_live_on_goes_no_faster_than_the_wall(
    graph: Graph, environ: dict[str, str], live: bool
) -> None:
    """A program drives the graph; what comes from the network is answered while time stands still."""
    graph.online(environ=environ, live=live)
    start = time.perf_counter()
    graph.run(1.0)
    assert graph.now().to_sec() >= 1001.0
    if live:
        assert time.perf_counter() - start > 0.9
    graph.offline()
    graph.run(100_000.0)  # of its own again, it is held back no more


def test_it_is_online_once(graph: Graph, environ: dict[str, str]) -> None:
    graph.offline()  # harmless
    graph.online(environ=environ)
    with pytest.raises(RosminiError, match=r"online already, at http://127\.0\.0\.1"):
        graph.online(environ=environ)
    graph.offline()
    graph.offline()
    graph.online(environ=environ)


def test_what_cannot_be_reached_or_served_is_refused_and_nothing_changes(graph: Graph) -> None:
    node = graph.node("node")
    before = node.uri, graph.master_uri, threading.active_count()
    with pytest.raises(MasterUnreachable, match=r"no-such-host\.invalid.*set ROS_IP or ROS_HOSTNAME"):
        graph.online("http://no-such-host.invalid:11311", environ={})
    assert (node.uri, graph.master_uri) == before[:2]
    assert not graph.keeps_time
    with connect({}) as elsewhere, pytest.raises(RosminiError, match="has its Master elsewhere already"):
        elsewhere.online(environ={})


def test_a_graph_that_ends_online_leaves_nothing(environ: dict[str, str]) -> None:
    with Graph() as graph:
        Pair(graph)
        graph.online(environ=environ)
        graph.run(0.1)
    assert graph.nodes == {}
    assert not any(thread.name == "rosmini-net" for thread in threading.enumerate())
    assert graph.master_uri == "http://localhost:11311/"
    with Graph() as again:
        again.online(environ=environ)  # the port is free


def test_a_graph_of_a_notebook_can_stand_still_online(graph: Graph, environ: dict[str, str]) -> None:
    graph.notebook = True
    graph.online(environ=environ, live=False)
    assert not graph.is_live
    assert graph.ask_as("/test").find("getParam", "/use_sim_time") is None
    now = graph.now()
    with connect(environ) as elsewhere:
        assert elsewhere.ask_as("/test").find("lookupNode", "/rosout") == graph.nodes["/rosout"].uri
    assert graph.now() == now


def test_graphs_that_ask_for_any_port_get_one_each(graph: Graph) -> None:
    with Graph() as other:
        for each in (graph, other):
            each.online("http://localhost:0", live=False)
        ports = {urlsplit(each.master_uri).port for each in (graph, other)}
    assert len(ports - {0, None}) == 2


def test_topics_outlive_a_master_that_is_served_no_more(
    graph: Graph, elsewhere: Graph, environ: dict[str, str]
) -> None:
    heard: list[str] = []
    publisher = graph.node("talker").publisher("chatter", String)
    online = graph.online(environ=environ)
    node = elsewhere.node("far")
    node.subscriber("chatter", String, lambda message: heard.append(message.data))
    together(graph, elsewhere, until=publisher.num_connections)
    assert online.server is not None
    online.server.close()
    publisher.publish("still here")
    together(graph, elsewhere, until=lambda: heard == ["still here"])
    graph.offline()
    assert graph.ask_as("/test").find("lookupNode", "/talker") == graph.nodes["/talker"].uri


def test_what_waits_for_a_master_that_has_gone_is_registered_at_the_own_one_again(
    graph: Graph, environ: dict[str, str]
) -> None:
    with Graph(simulated=False, transports=[LocalTransport, tcp()]) as home:
        assert isinstance(home.master, Master)
        where = addresses(environ)
        server = MasterServer(network_of(home).io, home.master, where, where.master[1])
        talker = graph.node("talker")
        graph.online(environ=environ)
        server.close()
        waiting = [
            in_lane(graph, lambda: talker.publisher("late", String)),
            in_lane(graph, lambda: talker.subscriber("late", String, print)),
            in_lane(graph, lambda: talker.service("late", Trigger, lambda _: None)),
        ]
        graph.run(0.5)
        assert waiting == [[], [], []]
        graph.offline()
        graph.run(1.0)
    assert not talker.is_shutdown()
    assert all(waiting)
    ask = graph.ask_as("/test").ask
    assert ask("lookupNode", "/talker") == talker.uri
    publishers, subscribers, services = ask("getSystemState")
    assert all(["/late", ["/talker"]] in part for part in (publishers, subscribers, services))
    assert ask("lookupService", "/late") == graph.transport.service_uri(talker.uri)
