"""A Master that goes away, comes back, forgets: the nodes of a process say so and register again."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from rosmini.core.graph import Graph, Node
from rosmini.core.graph.master import Master
from rosmini.msgs import message_class, service_class
from rosmini.ros.net import watch as module
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.master_server import MasterServer
from rosmini.ros.net.remote_master import RemoteMaster
from rosmini.ros.net.watch import Watch
from rosmini.ros.net.xmlrpc_client import XmlRpcClient

from ...processes import PATIENCE, free_port

String = message_class("std_msgs/String")
Trigger = service_class("std_srvs/Trigger")


class Deaf:
    """Hears what a Master would tell others, and tells nobody."""

    def publisher_update(self, caller_api: str, topic: str, uris: list[str]) -> None:
        """Tell nobody."""

    def param_update(self, caller_api: str, key: str, value: Any) -> None:
        """Tell nobody."""

    def shutdown(self, caller_api: str, reason: str) -> None:
        """Tell nobody."""

    def registrations_changed(self) -> None:
        """Tell nobody."""


@pytest.fixture
def io(monkeypatch: pytest.MonkeyPatch) -> Iterator[IoThread]:
    """The thread that reads and writes, where the Master is looked after often."""
    monkeypatch.setattr(module, "PERIOD_S", 0.05)
    made = IoThread()
    yield made
    made.close()


@contextmanager
def served(io: IoThread, port: int) -> Iterator[Master]:
    """A new Master at a port, which knows nothing."""
    master = Master("http://localhost/", Deaf())
    server = MasterServer(io, master, addresses({}), port)
    try:
        yield master
    finally:
        server.close()


@pytest.fixture
def port() -> int:
    """Where the Master is to be."""
    return free_port()


@pytest.fixture
def graph(io: IoThread, port: int) -> Iterator[Graph]:
    """A graph whose Master is elsewhere; shut down while it is gone, so as not to wait for it."""

    def away(graph: Graph) -> RemoteMaster:
        uri = f"http://127.0.0.1:{port}"
        client = XmlRpcClient(io, graph.scheduler)
        return RemoteMaster(uri, client, Watch(graph, uri, io, client))

    made = Graph(simulated=False, strict=False, master=away)
    yield made
    made.shutdown()


def until(graph: Graph, condition: Any) -> None:
    assert graph.run(PATIENCE, until=condition).reason == "condition"


def well_known(master: Master, node: Node) -> bool:
    """Tell whether the Master knows all that `busy` made a node register."""
    publishers, subscribers, services = master.getSystemState("/test")[2]
    expected = ["/news", [node.name]]
    return (
        expected in publishers
        and expected in subscribers
        and ["/ask", [node.name]] in services
        and master.lookupNode("/test", node.name)[2] == node.uri
    )


def count_calls(master: Master, method: str, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return a list that gets the caller of each call of a method."""
    callers: list[str] = []
    answer = getattr(master, method)

    def counted(caller_id: str) -> Any:
        callers.append(caller_id)
        return answer(caller_id)

    monkeypatch.setattr(master, method, counted)
    return callers


def busy(graph: Graph, name: str) -> Node:
    node = graph.node(name)
    node.publisher("news", String)
    node.subscriber("news", String, lambda _: None)
    node.service("ask", Trigger, lambda _: (True, ""))
    return node


def test_a_master_that_comes_back_knows_all_again(
    graph: Graph, io: IoThread, port: int, capsys: pytest.CaptureFixture[str]
) -> None:
    said: list[str] = []

    def has_said(text: str) -> bool:
        said.append(capsys.readouterr().err)
        return text in "".join(said)

    with served(io, port) as first:
        node = busy(graph, "node")
        assert well_known(first, node)
    until(graph, lambda: has_said("does not answer any more"))
    with served(io, port) as second:
        until(graph, lambda: well_known(second, node))
        until(graph, lambda: has_said("is back: /node registers again"))
        assert "".join(said).count("does not answer any more") == 1
        node.shutdown()
        assert second.getSystemState("/test")[2] == [[], [], []]


def test_what_was_cleaned_up_by_mistake_registers_again(graph: Graph, io: IoThread, port: int) -> None:
    """`rosnode cleanup` takes out a node that was stopped for a while."""
    with served(io, port) as master:
        node = busy(graph, "node")
        master.unregisterPublisher(node.name, "/news", node.uri)
        master.unregisterPublisher(node.name, "/rosout", node.uri)
        master.unregisterSubscriber(node.name, "/news", node.uri)
        master.unsubscribeParam(node.name, node.uri, "/speed")
        for service in ("/ask", "/node/get_loggers", "/node/set_logger_level"):
            master.unregisterService(node.name, service, graph.transport.service_uri(node.uri))
        assert master.lookupNode("/test", node.name)[0] == -1
        until(graph, lambda: well_known(master, node))
        graph.shutdown()


def test_a_node_whose_name_another_one_has_ends(
    graph: Graph, io: IoThread, port: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also where the Master's word does not reach it."""
    with served(io, port) as master:
        node, other = busy(graph, "node"), graph.node("other")
        master.registerPublisher(node.name, "/news", "std_msgs/String", "http://elsewhere:1/")
        until(graph, node.is_shutdown)
        assert not other.is_shutdown()
        assert "another node registered under its name" in capsys.readouterr().err
        assert master.lookupNode("/test", node.name)[2] == "http://elsewhere:1/"
        graph.shutdown()


def test_a_node_that_starts_is_not_taken_for_one_that_was_replaced(
    graph: Graph, io: IoThread, port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The Master still has the address of one that was killed, and answers the first registration slowly."""
    with served(io, port) as master:
        looks = count_calls(master, "getPid", monkeypatch)
        graph.node("other")
        master.registerPublisher("/node", "/news", "std_msgs/String", "http://elsewhere:1/")
        ask = graph.master.call

        def slow(method: str, caller_id: str, *arguments: Any) -> Any:
            begun = len(looks)
            while caller_id == "/node" and method == "registerPublisher" and len(looks) < begun + 5:
                graph.scheduler.sleep_until(graph.scheduler.now_ns() + 10_000_000)
            return ask(method, caller_id, *arguments)

        monkeypatch.setattr(graph.master, "call", slow)
        node = graph.node("node")
        begun = len(looks)
        until(graph, lambda: len(looks) >= begun + 5)
        assert not node.is_shutdown()
        assert master.lookupNode("/test", "/node")[2] == node.uri
        graph.shutdown()


def test_a_node_that_has_ended_does_not_come_back(graph: Graph, io: IoThread, port: int) -> None:
    with served(io, port) as master:
        node, other = busy(graph, "node"), graph.node("other")
        node.shutdown()
        graph.run(0.3)
        assert master.lookupNode("/test", node.name)[0] == -1
        assert master.lookupNode("/test", other.name)[0] == 1
        graph.shutdown()
