"""Whoever speaks to a node's slave API, or to a Master, as nobody should: the graph goes on."""

from __future__ import annotations

import socket
import struct
import xmlrpc.client
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rosmini.core.errors import TransportException
from rosmini.core.graph.master import Master
from rosmini.core.graph.master_port import METHODS as MASTER_METHODS
from rosmini.core.graph.slave import METHODS as SLAVE_METHODS
from rosmini.ros.net import http, xmlrpc_server
from rosmini.ros.net.addresses import addresses
from rosmini.ros.net.master_server import MasterServer
from rosmini.ros.net.network import network_of
from rosmini.ros.net.xmlrpc_text import decode

from .hostile import at, has_ended, say, slave_port_of, talk, unharmed, until

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rosmini.core.graph import Graph

HEAD = b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/xml\r\n"


def post(method: str, *arguments: Any, head: bytes = HEAD) -> bytes:
    """A call, as bytes."""
    body = xmlrpc.client.dumps(arguments, method, allow_none=True).encode()
    return head + b"Content-Length: %d\r\n\r\n" % len(body) + body


def chunked(*parts: bytes) -> bytes:
    """A call in chunks of HTTP."""
    chunks = b"".join(b"%x\r\n%s\r\n" % (len(part), part) for part in parts)
    return HEAD + b"Transfer-Encoding: chunked\r\n\r\n" + chunks


def nested(depth: int) -> bytes:
    """The document of a call with lists in lists."""
    opening, closing = b"<value><array><data>", b"</data></array></value>"
    return b"<methodCall><methodName>getPid</methodName><params><param>%s%s</param></params></methodCall>" % (
        opening * depth,
        closing * depth,
    )


CALL = xmlrpc.client.dumps(("/me",), "getPid").encode()
BOMB = b"""<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<methodCall><methodName>&b;</methodName><params/></methodCall>"""


@pytest.mark.parametrize("what", ["list", "struct"])
def test_a_document_of_a_hundred_thousand_levels_is_refused(what: str) -> None:
    document = nested(100_000)
    if what == "struct":
        document = document.replace(b"<array><data>", b"<struct><member><name>n</name>")
        document = document.replace(b"</data></array>", b"</member></struct>")
    with pytest.raises(TransportException, match="levels"):
        decode(document)
    assert decode(nested(20))[1] == "getPid"


@given(st.binary(max_size=300))
def test_any_bytes_are_a_document_or_refused(data: bytes) -> None:
    with suppress(TransportException):
        decode(data)
    with suppress(TransportException):
        decode(b"<methodCall><methodName>m</methodName><params><param>" + data)


@pytest.mark.parametrize(
    ("text", "status"),
    [
        (chunked(CALL[:20], CALL[20:], b""), b"200"),
        (chunked(b"<methodCall>", b"x" * 20_000), b"400"),
        (HEAD + b"Transfer-Encoding: chunked\r\n\r\nffffffffffffffffff\r\n", b"400"),
        (HEAD + b"Content-Length: -1\r\n\r\n", b"400"),
        (HEAD + b"Content-Length: " + b"9" * 30 + b"\r\n\r\n", b"400"),
        (HEAD + b"X: y\r\n" * 50_000, b"431"),
        (HEAD + b"Content-Length: 100\r\n\r\nshort", b"400"),
        (HEAD + b"Content-Length: %d\r\n\r\n" % len(BOMB) + BOMB, b"400"),
        (b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", b"405"),
        (b"\x00" * 1000, b"400"),
        (b"\n" * 200_000, b""),
        (bytes.fromhex("1603010200010001fc0303") + b"x" * 100, b"400"),
        (HEAD + b"Content-Length: %d\r\n\r\n" % len(nested(200)) + nested(200), b"400"),
    ],
)
def test_what_is_no_call_is_refused_by_a_node(
    graph: Graph, text: bytes, status: bytes, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(http, "BODY_LIMIT", 10_000)
    with unharmed(graph):
        for _ in range(3):
            answer = say(graph, slave_port_of(graph, "/talker"), text, finish=True)
            assert status in answer.partition(b"\r\n")[0] or (len(text) > 100_000 and not answer)
    said = capsys.readouterr().err
    assert said.count("WARN") == (status != b"200"), said
    assert (status == b"200") or "/talker refused a request from 127.0.0.1" in said


def test_silence_and_a_byte_now_and_then_are_given_up(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(xmlrpc_server, "FIRST_S", 0.5)
    with unharmed(graph):
        port = slave_port_of(graph, "/talker")
        silent, slow = at(port), at(port)
        sent = iter(post("getPid", "x" * 100_000))

        def dripped() -> bool:
            with suppress(BlockingIOError):
                slow.send(bytes([next(sent)]))
            return has_ended(slow)

        slow.setblocking(False)
        silent.setblocking(False)
        with suppress(ConnectionError):
            until(graph, dripped, "the end of its patience")
        until(graph, lambda: has_ended(silent), "the end of its patience")
        slow.close()
        silent.close()


@contextmanager
def served(graph: Graph) -> Iterator[MasterServer]:
    """The graph's Master at a port."""
    assert isinstance(graph.master, Master)
    server = MasterServer(network_of(graph).io, graph.master, addresses({}), 0)
    yield server
    server.close()


def test_who_does_not_read_the_answer_is_given_up(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    graph.ask_as("/test").ask("setParam", "/big", "x" * 20_000_000)
    with unharmed(graph), served(graph) as master:
        monkeypatch.setattr(xmlrpc_server, "IDLE_S", 0.5)
        with at(master.port) as raw:
            raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            raw.sendall(post("getParam", "/me", "/big"))
            tasks = master._server._tasks
            until(graph, lambda: tasks, "the call")
            until(graph, lambda: not tasks, "the end of its patience")


def test_only_so_many_connections_wait(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(xmlrpc_server, "WAITING", 10)
    with unharmed(graph):
        port = slave_port_of(graph, "/talker")
        silent = [at(port) for _ in range(40)]
        for one in silent:
            one.setblocking(False)
        until(graph, lambda: sum(map(has_ended, silent)) >= 30, "the end of the oldest")
        assert not any(map(has_ended, silent[-9:]))
        for one in silent:
            one.close()


@pytest.mark.parametrize("first", [b"", b"POST / HT", HEAD + b"Content-Length: 1000\r\n\r\nx", post("getPid", "/me")])
@pytest.mark.parametrize("reset", [False, True])
def test_a_thousand_connections_that_are_opened_and_dropped(
    graph: Graph, first: bytes, reset: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        port = slave_port_of(graph, "/talker")
        for _ in range(250):
            with at(port) as raw:
                if reset:
                    raw.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
                raw.sendall(first)
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert said.count("WARN") <= 1, said


VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**31), 2**31 - 1)
    | st.floats(allow_nan=False)
    | st.sampled_from(["", "/", "/t", "~", "a b", "http://127.0.0.1:1/", "rosrpc://x:y", "std_msgs/String"])
    | st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Cn"]), max_size=10)
    | st.binary(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text("abc/", max_size=3), inner, max_size=2),
    max_leaves=6,
)


@given(st.sampled_from(sorted(SLAVE_METHODS - {"shutdown"})), st.lists(VALUES, max_size=4))
def test_fuzz_of_the_slave_api(graph: Graph, method: str, arguments: list[Any]) -> None:
    """A triple or a fault is answered, and what was posted to the hub does no harm."""
    if "/talker" not in graph.nodes:
        talk(graph)
    answer = say(graph, slave_port_of(graph, "/talker"), post(method, *arguments), finish=True)
    _check(answer)
    graph.run(0)


@given(st.sampled_from(sorted(MASTER_METHODS - {"shutdown"}) + ["system.multicall"]), st.lists(VALUES, max_size=4))
def test_fuzz_of_the_master_api(graph: Graph, method: str, arguments: list[Any]) -> None:
    with served(graph) as master:
        _check(say(graph, master.port, post(method, *arguments), finish=True))
        state = say(graph, master.port, post("getSystemState", "/me"), finish=True)
        code, _, tables = _check(state)
        assert code == 1
        assert all(isinstance(name, str) for table in tables for topic, names in table for name in [topic, *names])
        _check(say(graph, master.port, post("getParam", "/me", "/"), finish=True))


def _check(answer: bytes) -> list[Any]:
    """Return what was answered. Fails unless it is a triple, or a fault."""
    head, _, body = answer.partition(b"\r\n\r\n")
    assert b" 200 " in head.splitlines()[0]
    try:
        (value,), _ = xmlrpc.client.loads(body, use_builtin_types=True)
    except xmlrpc.client.Fault:
        return [0, "", []]
    assert isinstance(value, list)
    return value


@pytest.mark.parametrize(
    "uris",
    [
        ["http://:"],
        ["rosrpc://127.0.0.1:1"],
        ["ftp://127.0.0.1:1/", "http://:", "http://127.0.0.1:99999/", "http://[::1", "http:// /"],
        ["http://no-such-host.invalid:1/", "http://a\x7fb:1/", "http://" + "a" * 300 + ":1/"],
        ["http://127.0.0.1:1/" + str(number) for number in range(30)],
    ],
)
def test_publishers_at_impossible_addresses(graph: Graph, uris: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with unharmed(graph):
        listener = graph.nodes["/listener"]
        talker = graph.nodes["/talker"].uri
        subscription = listener.subscriptions["/t"]
        before = subscription.updates
        say(graph, slave_port_of(graph, "/listener"), post("publisherUpdate", "/x", "/t", [talker, *uris]), finish=True)
        until(
            graph, lambda: subscription.updates > before and not set(subscription.connections) - {talker}, "their end"
        )
        say(graph, slave_port_of(graph, "/listener"), post("publisherUpdate", "/x", "/t", [talker]), finish=True)
        until(graph, lambda: subscription.updates > before + 1, "the news")
    said = capsys.readouterr().err
    assert "Traceback" not in said
