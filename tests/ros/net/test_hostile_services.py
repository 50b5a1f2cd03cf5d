"""Servers that answer garbage, late or never, and clients that do not listen: calls end, and the others go on."""

from __future__ import annotations

import socket
import struct
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import ServiceException
from rosmini.core.graph.headers import decode_header, encode_header
from rosmini.msgs.std_srvs.srv import SetBool, Trigger
from rosmini.ros.net import tcp_transport

from .hostile import RawServer, at, frame, port_of, say, unharmed, until

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.core.graph import Graph

NAME = "/evil"
HEADER = encode_header({"callerid": "/raw", "md5sum": Trigger._md5sum, "service": NAME, "type": Trigger._type})
CALLING = {"callerid": "/raw", "md5sum": "*", "service": "/ask", "persistent": "1"}


@contextmanager
def serving(graph: Graph, *answers: bytes) -> Iterator[RawServer]:
    """A raw server that the Master knows, for a while."""
    raw = RawServer(*answers)
    node, uri = graph.ask_as("/raw"), f"rosrpc://127.0.0.1:{raw.port}"
    node.ask("registerService", NAME, uri, "http://127.0.0.1:1/")
    try:
        yield raw
    finally:
        node.ask("unregisterService", NAME, uri)
        raw.close()


@pytest.mark.parametrize(
    ("answers", "says"),
    [
        ([b""], "unable to connect to service .*/evil.*closed before its header came"),
        ([HEADER[:9]], "unable to connect to service .*/evil.*closed before its header came"),
        ([struct.pack("<I", 2**32 - 1)], "not a node of ROS 1.*4294967295 bytes"),
        ([b"HTTP/1.1 400 Bad Request\r\n\r\n"], "not a node of ROS 1.*HTTP"),
        ([frame(frame(b"no equals sign"))], "not a node of ROS 1"),
        ([encode_header({"error": "not today"})], "unable to connect to service .*/evil.*not today"),
        ([HEADER], "unable to receive data from sender"),
        ([HEADER, b"\x01"], "unable to receive data from sender"),
        ([HEADER, b"\x01" + struct.pack("<I", 2**32 - 1)], "response cannot be read.*4294967295 bytes"),
        ([HEADER, b"\x01" + frame(b"\x01\xff\xff\xff\xffx")], "response cannot be read"),
        ([HEADER, b"\x01" + frame(b"")], "response cannot be read"),
        ([HEADER, b"\x00" + frame(b"\xff\xfe")], "responded with an error"),
    ],
)
@pytest.mark.parametrize("persistent", [False, True])
def test_a_server_that_answers_garbage_or_closes_early(
    graph: Graph, answers: list[bytes], says: str, persistent: bool
) -> None:
    with unharmed(graph), serving(graph, *answers):
        client = graph.node("client").service_client(NAME, Trigger, persistent=persistent)
        with pytest.raises(ServiceException, match=says):
            client()
        client.close()
        graph.nodes["/client"].shutdown()


def test_more_answers_than_questions_do_no_harm(graph: Graph) -> None:
    good = b"\x01" + frame(b"\x01" + frame(b"yes"))
    with unharmed(graph), serving(graph, HEADER, good * 5):
        assert graph.node("client").service_client(NAME, Trigger)().message == "yes"
        graph.nodes["/client"].shutdown()


@pytest.mark.parametrize("answers", [[], [b"\x10", b""]])
def test_a_server_that_stands_still_is_given_up(
    graph: Graph, answers: list[bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As one that was stopped by SIGSTOP: the system takes the connection, and nobody shows a header."""
    monkeypatch.setattr(tcp_transport, "CONNECT_S", 0.2)
    with unharmed(graph), serving(graph, *answers):
        with pytest.raises(ServiceException, match=r"/evil.*does not answer within 0\.2 s"):
            graph.node("client").service_client(NAME, Trigger)()
        graph.nodes["/client"].shutdown()


@pytest.mark.parametrize(
    "uri", ["rosrpc://127.0.0.1:1", "rosrpc://no-such-host.invalid:1", "rosrpc://:1", "http://x:1/"]
)
def test_a_server_at_an_impossible_address(graph: Graph, uri: str) -> None:
    with unharmed(graph):
        graph.ask_as("/raw").ask("registerService", NAME, uri, "http://127.0.0.1:1/")
        with pytest.raises(ServiceException, match="unable to connect to service"):
            graph.node("client").service_client(NAME, Trigger)()
        graph.ask_as("/raw").ask("unregisterService", NAME, uri)
        graph.nodes["/client"].shutdown()


def test_a_client_that_does_not_read_gets_no_more_answers(graph: Graph) -> None:
    """Each is kept until it is read, so that nothing piles up."""
    calls: list[Any] = []
    with unharmed(graph):
        server = graph.nodes["/talker"].service("/ask", Trigger, lambda _: (calls.append(1) or True, "x" * 500_000))
        with at(port_of(graph, "/talker")) as raw:
            raw.sendall(encode_header(CALLING) + frame(b"") * 100)
            for _ in range(50):
                graph.run(0.01)
            until(graph, lambda: calls, "a call")
            assert len(calls) < 60
            while len(calls) < 100:  # it goes on when they are read
                raw.setblocking(False)
                until(graph, lambda: _readable(raw), "an answer")
                raw.recv(1_000_000)
        until(graph, lambda: not server.sessions, "the end of its session")
        server.shutdown()


def _readable(raw: socket.socket) -> bool:
    try:
        return bool(raw.recv(1, socket.MSG_PEEK))
    except BlockingIOError:
        return False


@given(st.binary(max_size=60), st.booleans())
def test_fuzz_of_requests(graph: Graph, data: bytes, framed: bool) -> None:
    node = graph.nodes.get("/talker") or graph.node("talker")
    if "/ask" not in node.services:
        node.service("/ask", SetBool, lambda request: (request.data, "so it is"))
    request = frame(data) if framed else data
    answer = say(graph, port_of(graph, "/talker"), encode_header(CALLING) + request, finish=True)
    if answer:
        (length,) = struct.unpack_from("<I", answer)
        assert decode_header(answer[: 4 + length])["service"] == "/ask"
        assert answer[4 + length : 5 + length] in (b"", b"\x00", b"\x01")


def test_a_client_that_leaves_while_it_is_answered(graph: Graph) -> None:
    waiting: list[Any] = []

    def handle(_: Any) -> tuple[bool, str]:
        waiting.append(1)
        graph.nodes["/talker"].sleep(0.05)
        return True, "too late"

    with unharmed(graph):
        server = graph.nodes["/talker"].service("/ask", Trigger, handle)
        for number in range(1, 6):
            with at(port_of(graph, "/talker")) as raw:
                raw.sendall(encode_header(CALLING) + frame(b""))
                until(graph, lambda number=number: len(waiting) == number, "the call")
        until(graph, lambda: not server.sessions, "the end of all sessions")
        server.shutdown()
