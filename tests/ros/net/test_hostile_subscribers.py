"""Whoever connects to a node's port for topics and services, and is no proper subscriber: the graph goes on."""

from __future__ import annotations

import socket
import struct
import tracemalloc
from contextlib import suppress
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import DeserializationError
from rosmini.core.graph.headers import decode_fields, decode_header, encode_header
from rosmini.ros.net import tcp_server
from rosmini.ros.net.frames import FrameReader
from rosmini.ros.net.network import network_of

from ...conftest import nightly
from .hostile import at, frame, has_ended, port_of, say, subscribing, talk, unharmed, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph

GIB = struct.pack("<I", 2**32 - 1)


@given(st.binary(max_size=200))
def test_any_bytes_are_fields_of_a_header_or_refused(data: bytes) -> None:
    try:
        fields = decode_fields(data)
    except DeserializationError:
        return
    assert all(isinstance(text, str) for pair in fields.items() for text in pair)


@given(st.lists(st.binary(min_size=1, max_size=50), max_size=20), st.booleans())
def test_any_stream_gives_frames_or_is_refused_however_it_is_cut(parts: list[bytes], ok_byte: bool) -> None:
    def read(parts: list[bytes]) -> tuple[list[bytes], bool]:
        reader, found = FrameReader(ok_byte=ok_byte), []
        try:
            for part in parts:
                found += [bytes(one) for one in reader.feed(part)]
        except DeserializationError:
            return found, True
        return found, False

    whole, cut = read([b"".join(parts)]), read(parts)
    assert whole[1] == cut[1]
    assert whole[1] or whole == cut


@pytest.mark.parametrize(
    ("what", "text"),
    [
        ("too long", GIB),
        ("10 MB in one field", struct.pack("<II", 10 * 2**20 + 4, 10 * 2**20) + b"x" * (10 * 2**20)),
        ("no fields", frame(b"")),
        ("a field longer than the header", struct.pack("<II", 8, 99) + b"abcd"),
        ("no text", frame(frame(b"\xff\xfe=\xfd"))),
        ("no equals sign", frame(frame(b"topic"))),
        ("no md5 sum", encode_header({"topic": "/t"})),
        ("no such topic", encode_header({"topic": "/" + "n" * 100_000, "md5sum": "*"})),
        ("another md5 sum", encode_header({"topic": "/t", "md5sum": "0" * 32})),
        ("no such service", encode_header({"service": "/n", "md5sum": "*"})),
    ],
)
def test_who_shows_no_proper_header_is_refused(
    graph: Graph, what: str, text: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        capsys.readouterr()
        for _ in range(5):
            answer = say(graph, port_of(graph, "/talker"), text)
            if answer:
                assert decode_header(answer)["error"], what
    lines = [line for line in capsys.readouterr().err.splitlines() if "WARN" in line]
    assert len(lines) <= 1, lines
    assert all(len(line) < 1000 for line in lines)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (b"GET / HTTP/1.1\r\nHost: h\r\n\r\n", "HTTP"),
        (b"POST / HTTP/1.1\r\nHost: h\r\nContent-Length: 0\r\n\r\n", "HTTP"),
        (bytes.fromhex("1603010200010001fc0303") + b"x" * 100, "TLS"),
        (b"RTPS\x02\x03\x01\x0f" + b"x" * 100, "ROS 2"),
    ],
)
def test_what_another_protocol_says_is_told_by_its_name(
    graph: Graph, text: bytes, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        for _ in range(3):
            say(graph, port_of(graph, "/talker"), text)
    said = capsys.readouterr().err
    assert said.count("closed a connection from 127.0.0.1") == 1, said
    assert name in said


@given(st.binary(max_size=300), st.booleans())
def test_fuzz_at_the_port_of_a_node(graph: Graph, data: bytes, framed: bool) -> None:
    if "/talker" not in graph.nodes:
        talk(graph)
    answer = say(graph, port_of(graph, "/talker"), frame(data) if framed else data, finish=True)
    assert not answer or "error" in decode_header(answer)


@given(
    st.dictionaries(
        st.sampled_from(["callerid", "type", "message_definition", "tcp_nodelay", "persistent", "probe", "x"]),
        st.text(st.characters(exclude_categories=["Cs"]), max_size=30),
    ),
    st.sampled_from([{"topic": "/t"}, {"service": "/talker/get_loggers"}, {"topic": "/t", "service": "/t"}]),
    st.sampled_from(["*", "", "0" * 32]),
)
def test_fuzz_of_the_fields_of_a_header(graph: Graph, fields: dict[str, str], kind: dict[str, str], md5: str) -> None:
    if "/talker" not in graph.nodes:
        talk(graph)
    header = encode_header({**fields, **kind, "md5sum": md5})
    with at(port_of(graph, "/talker")) as raw:
        raw.sendall(header)
        raw.setblocking(False)
        got: list[bytes] = []

        def answered() -> bool:
            with suppress(BlockingIOError):
                got.append(raw.recv(65536))
            return bool(got)

        until(graph, answered, "an answer")
    assert network_of(graph).client.call(graph.nodes["/talker"].uri, "getBusInfo", "/test")[0] == 1


def test_connections_that_never_send_a_header_are_closed_in_time(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tcp_server, "HANDSHAKE_S", 0.2)
    with unharmed(graph):
        silent = [at(port_of(graph, "/talker")) for _ in range(20)]
        silent[0].sendall(b"\x10")
        for one in silent:
            one.setblocking(False)
        for one in silent:
            until(graph, lambda one=one: has_ended(one), "its end")
            one.close()
    assert capsys.readouterr().err.count("sent no header") == 1


def test_a_header_that_comes_byte_by_byte_is_given_up(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tcp_server, "HANDSHAKE_S", 0.5)
    header = subscribing(long="x" * 10_000)
    with unharmed(graph), at(port_of(graph, "/talker")) as raw:
        sent = 0

        def dripped() -> bool:
            nonlocal sent
            try:
                raw.sendall(header[sent : sent + 1])
            except ConnectionError:
                return True
            sent += 1
            return False

        until(graph, dripped, "the end of its patience")
        assert sent < len(header)


def test_only_so_many_wait_to_say_what_they_want(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tcp_server, "WAITING", 10)
    with unharmed(graph):
        port = port_of(graph, "/talker")
        silent = [at(port) for _ in range(40)]
        for one in silent:
            one.setblocking(False)
        until(graph, lambda: sum(map(has_ended, silent)) >= 30, "the end of the oldest")
        assert not any(map(has_ended, silent[-10:]))
        for one in silent:
            one.close()


@pytest.mark.parametrize(
    ("first", "reset"),
    [
        (b"", False),
        (subscribing(), True),
        *nightly((b"\x04", True), (subscribing()[:20], False), (subscribing(), False)),
    ],
)
def test_hundreds_of_connections_that_are_opened_and_dropped(
    graph: Graph, first: bytes, reset: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        port = port_of(graph, "/talker")
        for number in range(250):
            with at(port) as raw:
                if reset:
                    raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                raw.sendall(first)
            if not number % 25:
                graph.run(0)
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert said.count("WARN") <= 1, said


def test_a_subscriber_that_stops_reading_holds_nobody_up(graph: Graph) -> None:
    with unharmed(graph) as (publisher, heard), at(port_of(graph, "/talker")) as raw:
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        raw.sendall(subscribing())
        publication = graph.nodes["/talker"].publications["/t"]
        until(graph, lambda: len(publication.senders) == 2, "the subscriber that will not read")
        for count in range(1, 201):  # 20 MB: more than the queue and the system keep for a connection
            publisher.publish("x" * 100_000)
            until(graph, lambda count=count: len(heard) == count, "what the others hear")
        stuck = next(one for one in publication.senders.values() if one.destination == "/raw")
        assert stuck.dropped
    until(graph, lambda: publisher.num_connections() == 1, "its end")


def test_what_a_subscriber_says_after_its_header_is_thrown_away(graph: Graph) -> None:
    with unharmed(graph), at(port_of(graph, "/talker")) as raw:
        raw.sendall(subscribing())
        publication = graph.nodes["/talker"].publications["/t"]
        until(graph, lambda: len(publication.senders) == 2, "a subscriber")
        tracemalloc.start()
        try:
            raw.sendall(struct.pack("<I", 10**9))
            raw.setblocking(False)
            sent, piece = 0, b"y" * 2**20

            def told() -> bool:
                nonlocal sent
                with suppress(BlockingIOError):
                    sent += raw.send(piece)
                return sent > 32 * 2**20

            until(graph, told, "its words")
            assert tracemalloc.get_traced_memory()[1] < 8 * 2**20
        finally:
            tracemalloc.stop()


@pytest.mark.parametrize("header", [subscribing(), encode_header({"service": "/talker/get_loggers", "md5sum": "*"})])
def test_who_says_what_for_when_the_node_has_ended_is_refused(graph: Graph, header: bytes) -> None:
    """Else the connection would stay, with nobody to close it."""
    talk(graph)
    port = port_of(graph, "/talker")
    with at(port) as raw:
        say(graph, port, encode_header({}))  # the one before it has been accepted, too
        graph.nodes["/talker"].shutdown()
        raw.sendall(header)
        raw.setblocking(False)
        answer = bytearray()

        def closed() -> bool:
            with suppress(BlockingIOError):
                part = raw.recv(65536)
                answer.extend(part)
                return not part
            return False

        until(graph, closed, "its end")
    assert "is not a" in decode_header(bytes(answer))["error"]
