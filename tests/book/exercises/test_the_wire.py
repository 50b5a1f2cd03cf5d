"""The chapter The wire: it leaves nothing open, and its table of refusals is what is answered."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from typing import Any, cast
from xmlrpc.client import ServerProxy

import pytest

from book.tools import notebooks
from rosmini.book.checks import Status, find
from rosmini.core.errors import TransportInitError
from rosmini.core.graph import Graph
from rosmini.msgs.sensor_msgs.msg import LaserScan, Range


def test_no_port_of_a_run_is_stored(cells: Any) -> None:
    outputs = [text for cell in cells for output in cell.get("outputs", []) for text in notebooks.texts(output)]
    assert not re.search(r"localhost(:|', )\d", "\n".join(outputs))
    assert "localhost:TALKER" in "\n".join(outputs)


class Nobody:
    """A subscriber's end that is refused before anything is sent."""

    protocol = "TCPROS"
    destination = "/c"


@pytest.fixture
def graph() -> Iterator[Graph]:
    with Graph() as made:
        made.node("simulator").publisher("scan", LaserScan)
        yield made


def test_the_refusals_of_the_exercise_are_what_is_answered(graph: Graph, prose: str) -> None:
    rows = re.findall(r"^\| (\d) \| (.*?) \| `error=(.*?)` \|$", prose, re.MULTILINE)
    assert [number for number, _, _ in rows] == ["1", "2", "3"]
    for _, fields, error in rows:
        header = dict(re.findall(r"`(\w+)=(.*?)`", fields))
        with pytest.raises(TransportInitError) as caught:
            graph.nodes["/simulator"].accept_subscriber(header, Nobody())  # type: ignore[arg-type]
        for piece in error.removesuffix(".").split("..."):
            assert piece in str(caught.value)
    assert Range._md5sum in rows[2][1]


def test_a_tuple_of_names_is_right_too() -> None:
    assert find("culprits").grade(("topic", "md5sum", "md5sum")).status is Status.RIGHT


def test_who_asks_once_for_all_bytes_is_told_to_ask_again() -> None:
    def hear(master: Any, connect: Any, topic: str, kind: str, md5sum: str) -> bytes:
        uri = master.registerSubscriber("/ear", topic, kind, "http://localhost:9/")[2][0]
        with ServerProxy(uri) as node:
            _, host, port = cast("Any", node.requestTopic("/ear", topic, [["TCPROS"]]))[2]
        sock = connect((host, port))
        fields = f"callerid=/ear|topic={topic}|type={kind}|md5sum={md5sum}".encode().split(b"|")
        body = b"".join(struct.pack("<I", len(field)) + field for field in fields)
        sock.sendall(struct.pack("<I", len(body)) + body)
        return bytes(sock.recv(struct.unpack("<I", sock.recv(4))[0]))

    assert "recv(n) may return fewer than n bytes" in find("hear").grade(hear).text
