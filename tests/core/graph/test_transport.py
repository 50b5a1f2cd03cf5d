"""Several transports in one graph, and transports whose threads fail."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import ServiceException
from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import String
from tests.core.graph.byte_transport import ByteTransport

from .conftest import close, until

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph whose nodes hand messages over, or exchange bytes with those that are not in this process."""
    graph = Graph(transports=[LocalTransport, ByteTransport])
    yield graph
    close(graph)


def elsewhere(graph: Graph, name: str) -> Any:
    """A node as if it were in another process: the first transport does not know it."""
    node = graph.node(name)
    graph.transport.transports[0].detach(node.uri)
    return node


def ways(node: Any) -> dict[str, str]:
    """Which way each connection of a node goes, by topic and peer."""
    return {row[6].rpartition(" ")[2] + row[4]: row[3] for row in node.slave.getBusInfo("/test")[2]}


def test_each_connection_goes_the_first_way_that_both_ends_offer(graph: Graph) -> None:
    heard: list[tuple[str, str]] = []
    talker, near, far = graph.node("talker"), graph.node("near"), elsewhere(graph, "far")
    for node in (near, far):
        node.subscriber("chatter", String, lambda message, node=node: heard.append((node.name, message.data)))
    publisher = talker.publisher("chatter", String)
    publisher.wait_for_subscribers(2)
    publisher.publish("x")
    until(graph, lambda: len(heard) == 2)
    assert sorted(heard) == [("/far", "x"), ("/near", "x")]
    assert ways(talker)["[/near]/chatter"] == "INPROC"
    assert ways(talker)["[/far]/chatter"] == "BYTES"
    assert ways(far)["[/talker]/chatter"] == "BYTES"


def test_service_calls_find_their_way(graph: Graph) -> None:
    near, far = graph.node("near"), elsewhere(graph, "far")
    near.service("add_near", AddTwoInts, lambda request: request.a + request.b)
    far.service("add_far", AddTwoInts, lambda request: request.a + request.b)
    for caller in (near, far):
        for name in ("add_near", "add_far"):
            assert caller.service_client(name, AddTwoInts)(1, 2).sum == 3


@pytest.mark.parametrize("when", ["connect", "send", "receive"])
def test_a_transport_that_raises_costs_one_connection_and_one_warning(
    when: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    graph = Graph(transports=[ByteTransport])
    heard: list[str] = []
    talker, listener = graph.node("talker"), graph.node("listener")

    def fail(*_: Any) -> None:
        raise OSError("the cable is cut")

    publisher = talker.publisher("chatter", String)
    graph.run(1.0)
    if when == "connect":
        wire = graph.transport.transports[0]._endpoints[talker.uri][1]  # type: ignore[attr-defined]
        carry = wire.carry

        def fail_once(_: Any, failed: Any) -> None:
            wire.carry = carry
            carry(fail, failed)

        wire.carry = fail_once
    subscriber = listener.subscriber("chatter", String, lambda message: heard.append(message.data))
    if when != "connect":
        publisher.wait_for_subscribers()
        monkeypatch.setattr(String, "_encode" if when == "send" else "_read", fail)
        publisher.publish("lost")
    assert graph.run(1.0).reason == "time"
    if when != "connect":  # a later publisherUpdate asks for it again
        assert subscriber.num_connections() == publisher.num_connections() == 0
    told = [line for line in capsys.readouterr().err.splitlines() if "the cable is cut" in line]
    assert len(told) == 1
    what = (
        "listener cannot connect to /talker, which publishes /chatter at "
        if when == "connect"
        else "on /chatter failed"
    )
    assert what in told[0]
    assert heard == []
    monkeypatch.undo()
    close(graph)


def test_a_service_call_over_a_transport_that_raises_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    graph = Graph(transports=[ByteTransport])
    graph.node("server").service("add", AddTwoInts, lambda request: request.a + request.b)
    client = graph.node("client").service_client("add", AddTwoInts, persistent=True)
    assert client(1, 2).sum == 3

    def fail(*_: Any) -> None:
        raise OSError("the cable is cut")

    monkeypatch.setattr(AddTwoInts._request_class, "_read", fail)
    with pytest.raises(ServiceException, match="transport error completing service call: OSError: the cable is cut"):
        client(1, 2)
    monkeypatch.undo()
    close(graph)
