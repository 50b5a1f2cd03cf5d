"""Two nodes on TCPROS, and peers at their ports that send what none should."""

from __future__ import annotations

import asyncio
import re
import socket
import struct
import threading
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import TransportInitError, TypeMismatch
from rosmini.core.graph import Graph
from rosmini.core.graph.headers import encode_header
from rosmini.core.graph.publisher import Publication
from rosmini.msgs import define_message
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.ros.net import tcp_transport
from rosmini.ros.net.network import network_of, tcp
from rosmini.ros.rospy.msg import AnyMsg

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph whose nodes know only the network; it leaves no thread behind."""
    graph = Graph(simulated=False, transports=[tcp()])
    yield graph
    graph.shutdown("the test is over")
    assert not any(thread.name == "rosmini-net" for thread in threading.enumerate())


def until(graph: Graph, condition: Callable[[], object]) -> None:
    assert graph.run(PATIENCE, until=lambda: bool(condition())).reason == "condition"


def talk(graph: Graph) -> tuple[Any, list[str]]:
    """A publisher whose subscriber is there at both ends, and what that hears."""
    heard: list[str] = []
    subscriber = graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
    publisher = graph.node("talker").publisher("t", String, queue_size=100)
    until(graph, lambda: publisher.num_connections() and subscriber.num_connections())
    return publisher, heard


def port_of(graph: Graph, name: str) -> int:
    uri = network_of(graph).transport.service_uri(graph.nodes[name].uri)
    return int(uri.rpartition(":")[2])


def say(graph: Graph, port: int, text: bytes) -> bytes:
    """Send bytes to a port, drive the graph, and return the answer until the node closes."""
    got: list[bytes] = []

    def peer() -> None:
        with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as raw:
            parts = []
            try:
                raw.sendall(text)
                while part := raw.recv(65536):
                    parts.append(part)
            except ConnectionError:
                pass
            got.append(b"".join(parts))

    thread = threading.Thread(target=peer, daemon=True)
    thread.start()
    until(graph, lambda: got)
    thread.join(PATIENCE)
    return got[0]


@pytest.mark.parametrize("returns", [False, True], ids=["leaves", "leaves and returns"])
def test_who_is_still_connecting_hears_the_last_words(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, returns: bool
) -> None:
    """The publisher counts a subscriber that has not read its answer yet; then it publishes, and leaves."""
    gate, open_topic = asyncio.Event(), tcp_transport.open_topic

    async def open_late(io: Any, host: str, port: int, header: Any) -> Any:
        opened = await open_topic(io, host, port, header)
        if header["topic"] == "/t":
            await gate.wait()
        return opened

    monkeypatch.setattr(tcp_transport, "open_topic", open_late)
    heard: list[str] = []
    talker, listener = graph.node("talker"), graph.node("listener")
    listener.subscriber("t", String, lambda message: heard.append(message.data))
    publisher = talker.publisher("t", String, queue_size=10)
    until(graph, publisher.num_connections)
    subscription = listener.subscriptions["/t"]
    news = subscription.updates
    publisher.publish("last words")
    publisher.unregister()
    until(graph, lambda: subscription.updates == news + 1)
    if returns:
        publisher = talker.publisher("t", String, queue_size=10)
        until(graph, lambda: subscription.updates == news + 2)
    network_of(graph).io.call(gate.set)
    until(graph, lambda: heard)
    if returns:
        until(graph, publisher.num_connections)
        publisher.publish("back")
        until(graph, lambda: len(heard) == 2)
    assert heard == ["last words", "back"][: 1 + returns]


def test_a_connection_that_its_publisher_left_meanwhile_is_made_again_when_it_is_back(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    gate, open_topic = asyncio.Event(), tcp_transport.open_topic

    async def refused_late(io: Any, host: str, port: int, header: Any) -> Any:
        if header["topic"] == "/t" and not gate.is_set():
            await gate.wait()
            raise TransportInitError(f"{header['callerid']} comes too late")
        return await open_topic(io, host, port, header)

    monkeypatch.setattr(tcp_transport, "open_topic", refused_late)
    talker, listener = graph.node("talker"), graph.node("listener")
    listener.subscriber("t", String)
    subscription = listener.subscriptions["/t"]
    publisher = talker.publisher("t", String, queue_size=10)
    until(graph, lambda: subscription.connections)
    news = subscription.updates
    publisher.unregister()
    until(graph, lambda: subscription.updates == news + 1)
    publisher = talker.publisher("t", String, queue_size=10)
    until(graph, lambda: subscription.updates == news + 2)
    network_of(graph).io.call(gate.set)
    until(graph, publisher.num_connections)
    assert "too late" not in capsys.readouterr().err


def test_messages_and_services_cross_the_wire(graph: Graph) -> None:
    publisher, heard = talk(graph)
    for number in range(50):
        publisher.publish(f"hello {number}")
    until(graph, lambda: len(heard) == 50)
    assert heard == [f"hello {number}" for number in range(50)]
    graph.nodes["/talker"].service("add", AddTwoInts, lambda request: request.a + request.b)
    assert graph.nodes["/listener"].service_client("add", AddTwoInts)(1, 2).sum == 3
    client = graph.nodes["/listener"].service_client("add", AddTwoInts, persistent=True)
    assert [client(number, 1).sum for number in range(5)] == [1, 2, 3, 4, 5]
    client.close()


def test_another_type_is_told_with_what_differs(graph: Graph) -> None:
    graph.node("talker").publisher("t", String)
    with pytest.raises(TypeMismatch, match=r"(?s)- string data.*\+ int32 data"):
        graph.node("listener").subscriber("t", Int32)
        graph.run(PATIENCE)


def test_the_bus_tells_ports_and_sockets_as_rospy_does(graph: Graph) -> None:
    publisher, _ = talk(graph)
    (out,) = [row for row in graph.nodes["/talker"].slave.getBusInfo("/test")[2] if row[4] == "/t"]
    (into,) = [row for row in graph.nodes["/listener"].slave.getBusInfo("/test")[2] if row[4] == "/t"]
    pattern = r"TCPROS connection on port (\d+) to \[(127\.0\.0\.1|localhost):(\d+) on socket \d+\]"
    outward, inward = re.fullmatch(pattern, out[6]), re.fullmatch(pattern, into[6])
    assert outward is not None
    assert inward is not None
    assert int(outward[1]) == int(inward[3]) == port_of(graph, "/talker")
    assert (outward[3], outward[2], inward[2]) == (inward[1], "127.0.0.1", "localhost")
    assert publisher.num_connections() == 1


def test_what_is_published_is_sent_at_once_and_a_subscriber_asks_others_for_that(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[str, bool]] = []
    accept = Publication.accept

    def listen(self: Publication, header: dict[str, str], sender: Any) -> dict[str, str]:
        if self.topic == "/t":
            sock = sender._stream._socket
            is_on = sock.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY) != 0
            asked.append((header["tcp_nodelay"], is_on))
        return accept(self, header, sender)

    monkeypatch.setattr(Publication, "accept", listen)
    graph.node("talker").publisher("t", String)
    for name, tcp_nodelay in (("calm", False), ("hasty", True)):
        subscriber = graph.node(name).subscriber("t", String, tcp_nodelay=tcp_nodelay)
        until(graph, subscriber.num_connections)
    assert asked == [("0", True), ("1", True)]


def test_requests_that_come_at_once_are_answered_one_after_the_other(graph: Graph) -> None:
    graph.node("talker").service("add", AddTwoInts, lambda request: request.a + request.b)
    until(graph, lambda: network_of(graph).transport.service_uri(graph.nodes["/talker"].uri))
    header = encode_header({"service": "/add", "md5sum": AddTwoInts._md5sum, "callerid": "/raw", "persistent": "1"})
    requests = b"".join(struct.pack("<Iqq", 16, number, 1) for number in range(200))
    got: list[bytes] = []

    def peer() -> None:
        with socket.create_connection(("127.0.0.1", port_of(graph, "/talker")), timeout=PATIENCE) as raw:
            raw.sendall(header + requests[:50])
            file = raw.makefile("rb")
            (length,) = struct.unpack("<I", file.read(4))
            file.read(length)
            raw.sendall(requests[50:])
            got.append(file.read(200 * 13))

    thread = threading.Thread(target=peer, daemon=True)
    thread.start()
    until(graph, lambda: got)
    thread.join(PATIENCE)
    assert [struct.unpack("<BIq", got[0][at : at + 13]) for at in range(0, 2600, 13)] == [
        (1, 8, number + 1) for number in range(200)
    ]


@pytest.mark.parametrize("is_told_truly", [True, False])
def test_a_subscriber_of_any_type_makes_the_class_that_the_publisher_describes(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, is_told_truly: bool
) -> None:
    """Only if it has the md5 sum that the publisher says; else the bytes stay bytes."""
    odd = define_message("odd_pkg/Odd", "std_msgs/Header header\nfloat64[] values\n")
    if not is_told_truly:
        monkeypatch.setattr(odd, "_full_text", "float64 other\n")
    heard: list[Any] = []
    graph.node("talker").publisher("t", odd, latch=True).publish(values=[1.5, 2.0])
    graph.node("listener").subscriber("t", AnyMsg, heard.append)
    until(graph, lambda: heard)
    if is_told_truly:
        assert (heard[0]._type, list(heard[0].values)) == ("odd_pkg/Odd", [1.5, 2.0])
        assert type(heard[0]) is not odd
    else:
        assert isinstance(heard[0], AnyMsg)
