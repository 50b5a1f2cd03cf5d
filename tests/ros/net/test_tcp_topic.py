"""When messages leave, and what a subscriber that reads slowly loses: the publisher waits for nobody."""

from __future__ import annotations

import socket
import struct
from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph import Graph
from rosmini.core.graph.headers import encode_header
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.net.network import network_of, tcp

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import BinaryIO

SIZE = 100_000


@pytest.fixture
def graph() -> Iterator[Graph]:
    """A graph whose nodes know only the network."""
    with Graph(simulated=False, transports=[tcp()]) as graph:
        yield graph


def number_of(stream: BinaryIO) -> int:
    """Read the next message; it is what was published."""
    (length,) = struct.unpack("<I", stream.read(4))
    body = stream.read(length)
    (count,) = struct.unpack_from("<I", body)
    text = body[4:].decode()
    assert len(text) == count == SIZE
    return int(text[:6])


def test_a_message_leaves_at_once_whatever_its_publisher_does_next(graph: Graph) -> None:
    publisher = graph.node("talker").publisher("t", String, queue_size=10)
    port = int(network_of(graph).transport.service_uri(graph.nodes["/talker"].uri).rpartition(":")[2])
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as raw, raw.makefile("rb") as stream:
        raw.sendall(encode_header({"topic": "/t", "md5sum": "*", "type": "*", "callerid": "/raw"}))
        graph.run(PATIENCE, until=publisher.num_connections)
        publisher.publish("7".zfill(6).ljust(SIZE, "x"))
        (length,) = struct.unpack("<I", stream.read(4))  # the graph stands still meanwhile
        stream.read(length)
        assert number_of(stream) == 7


@pytest.mark.parametrize("queue_size", [10, None])
def test_a_slow_reader_loses_the_oldest_and_holds_nobody_up(
    graph: Graph, queue_size: int | None, capsys: pytest.CaptureFixture[str]
) -> None:
    publisher = graph.node("talker").publisher("t", String, queue_size=queue_size)
    port = int(network_of(graph).transport.service_uri(graph.nodes["/talker"].uri).rpartition(":")[2])
    with socket.socket() as raw:
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 64 * 1024)
        raw.settimeout(PATIENCE)
        raw.connect(("127.0.0.1", port))
        raw.sendall(encode_header({"topic": "/t", "md5sum": "*", "type": "*", "callerid": "/slow"}))
        graph.run(PATIENCE, until=publisher.num_connections)
        total = 300 if queue_size else 1000
        for number in range(total):
            publisher.publish(f"{number:06}".ljust(SIZE, "x"))
        (sender,) = graph.nodes["/talker"].publications["/t"].senders.values()
        dropped = sender.dropped
        assert dropped > 0
        with raw.makefile("rb") as stream:
            (length,) = struct.unpack("<I", stream.read(4))
            stream.read(length)
            seen = [number_of(stream)]
            while seen[-1] < total - 1:
                seen.append(number_of(stream))
        assert seen[0] == 0
        assert seen == sorted(set(seen))
        assert len(seen) == total - dropped
    assert ("no queue_size" in capsys.readouterr().err) == (queue_size is None)
