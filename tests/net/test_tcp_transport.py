"""Two nodes on TCPROS, and peers at their ports that send what none should."""

from __future__ import annotations

import socket
import struct
import threading
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.errors import TypeMismatch
from rosmini.graph import Graph
from rosmini.graph.headers import decode_header, encode_header
from rosmini.msgs.rospy_tutorials.srv import AddTwoInts
from rosmini.msgs.std_msgs.msg import Int32, String
from rosmini.net.network import network_of, tcp

from ..processes import PATIENCE

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


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (struct.pack("<I", 2**32 - 1), ""),
        (struct.pack("<I", 10 * 2**20) + b"x" * 1000, ""),
        (encode_header({"hello": "world"}), "no topic or service name detected"),
        (encode_header({"topic": "/nope", "md5sum": "*"}), "is not a publisher of [/nope]"),
        (encode_header({"topic": "/t"}), "Missing required 'md5sum' field"),
        (encode_header({"service": "/nope", "md5sum": "*"}), "is not a provider of [/nope]"),
        (struct.pack("<II", 8, 99) + b"abcd", "claims 99 bytes"),
    ],
)
def test_who_sends_no_proper_header_is_refused_and_the_graph_goes_on(
    graph: Graph, text: bytes, says: str
) -> None:
    publisher, heard = talk(graph)
    answer = say(graph, port_of(graph, "/talker"), text)
    assert says in (decode_header(answer)["error"] if answer else "")
    publisher.publish("still here")
    until(graph, lambda: heard == ["still here"])
