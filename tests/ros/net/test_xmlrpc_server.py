"""The two ends of XML-RPC, each against the other, against Python's own, and against what no peer should send."""

from __future__ import annotations

import socket
import threading
import xmlrpc.client
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.graph.scheduler import Scheduler
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.xmlrpc_client import XmlRpcClient
from rosmini.ros.net.xmlrpc_server import XmlRpcServer
from rosmini.ros.net.xmlrpc_text import XmlRpcFault

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Iterator


def handler(method: str, arguments: tuple[Any, ...]) -> Any:
    """Answer as a node would."""
    if method == "refuse":
        raise XmlRpcFault(4, "not so")
    if method == "fail":
        raise KeyError("lost")
    if method == "none":
        return None
    return [1, method, list(arguments)]


@pytest.fixture
def io() -> Iterator[IoThread]:
    """The thread that reads and writes; none is left behind."""
    io = IoThread()
    yield io
    io.close()
    assert not any(thread.name == "rosmini-net" for thread in threading.enumerate())


@pytest.fixture
def server(io: IoThread) -> Iterator[XmlRpcServer]:
    """A server that tells what it was asked."""
    server = XmlRpcServer(io, handler)
    yield server
    server.close()


@pytest.fixture
def client(io: IoThread) -> XmlRpcClient:
    """A client of the same thread."""
    return XmlRpcClient(io, Scheduler(simulated=False))


def uri_of(server: XmlRpcServer) -> str:
    return f"http://127.0.0.1:{server.port}/"


def say(server: XmlRpcServer, text: bytes) -> bytes:
    """Send bytes to a server and return all that it answers until it closes."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as raw:
        parts = []
        with suppress(ConnectionError):  # it may close before it has read all
            raw.sendall(text)
            with suppress(OSError):  # it has closed already
                raw.shutdown(socket.SHUT_WR)
            while part := raw.recv(65536):
                parts.append(part)
        return b"".join(parts)


VALUES = [1, -1.5, True, "chäpter", "a<b&c>\n", [], [1, ["x"]], {"a": {"b": [False]}}]


def test_values_arrive_as_they_were_sent(server: XmlRpcServer, client: XmlRpcClient) -> None:
    for _ in range(2):  # the second time on the connection of the first
        assert client.call(uri_of(server), "getParam", *VALUES) == [1, "getParam", VALUES]


def test_bytes_arrive(server: XmlRpcServer, client: XmlRpcClient) -> None:
    assert client.call(uri_of(server), "setParam", b"\x00\xff")[2][0] == b"\x00\xff"


def test_pythons_own_client_is_served(server: XmlRpcServer) -> None:
    with xmlrpc.client.ServerProxy(uri_of(server)) as proxy:
        assert proxy.getPid("/me") == [1, "getPid", ["/me"]]
        with pytest.raises(xmlrpc.client.Fault, match="not so"):
            proxy.refuse()
        with pytest.raises(xmlrpc.client.Fault, match="KeyError"):
            proxy.fail()
        with pytest.raises(xmlrpc.client.Fault, match="cannot be written"):
            proxy.none()
        assert proxy.getPid("/me") == [1, "getPid", ["/me"]]


def test_a_fault_is_an_error_with_its_text(server: XmlRpcServer, client: XmlRpcClient) -> None:
    with pytest.raises(XmlRpcFault, match="not so") as caught:
        client.call(uri_of(server), "refuse")
    assert (caught.value.code, caught.value.text) == (4, "not so")


def test_a_port_in_use_is_told_at_once(io: IoThread, server: XmlRpcServer) -> None:
    with pytest.raises(OSError, match="in use"):
        XmlRpcServer(io, handler, port=server.port)


def test_a_closed_server_leaves_its_port(io: IoThread, client: XmlRpcClient) -> None:
    first = XmlRpcServer(io, handler)
    assert client.call(uri_of(first), "getPid")
    first.close()
    io.start(_nothing()).result(PATIENCE)
    second = XmlRpcServer(io, handler, port=first.port)
    assert client.call(uri_of(second), "getPid")  # on a new connection: the kept one was closed
    second.close()


async def _nothing() -> None:
    """Take a turn of the loop."""


CALL = xmlrpc.client.dumps(("/me",), "getPid").encode()


def post(body: bytes, *, version: str = "1.1", extra: str = "") -> bytes:
    head = f"POST /any/path HTTP/{version}\r\nHost: localhost\r\nContent-Type: text/xml\r\n"
    return f"{head}Content-length: {len(body)}\r\n{extra}\r\n".encode() + body


@pytest.mark.parametrize("version", ["1.0", "1.1"])
def test_a_plain_call_is_answered_in_each_version_of_http(server: XmlRpcServer, version: str) -> None:
    answer = say(server, post(CALL, version=version))
    assert answer.startswith(b"HTTP/1.1 200")
    assert xmlrpc.client.loads(answer.partition(b"\r\n\r\n")[2])[0][0] == [1, "getPid", ["/me"]]


def test_two_calls_in_one_packet_get_two_answers(server: XmlRpcServer) -> None:
    assert say(server, post(CALL) + post(CALL)).count(b"HTTP/1.1 200") == 2


def test_a_refused_request_calls_nothing_and_is_logged_once(io: IoThread, client: XmlRpcClient) -> None:
    called: list[str] = []
    logged: list[tuple[str, str]] = []

    def answer(method: str, _arguments: tuple[Any, ...]) -> int:
        called.append(method)
        return 1

    server = XmlRpcServer(io, answer, warn=lambda *line: logged.append(line))
    for field in ("Origin: http://evil.example\r\n", "Content-Type: text/plain\r\n"):
        for _ in range(2):
            head, _, body = say(server, post(CALL, extra=field) + post(CALL)).partition(b"\r\n\r\n")
            assert head.startswith((b"HTTP/1.1 403", b"HTTP/1.1 415"))
            assert b"connection: close" in head.lower()
            assert b"web page" in body
    assert called == []
    ((host, line),) = logged
    assert host == "127.0.0.1"
    assert "'http://evil.example'" in line
    assert client.call(uri_of(server), "getPid") == 1
    server.close()


def test_the_error_of_pythons_client_says_why(server: XmlRpcServer) -> None:
    """So do those of rospy and of ROS's tools."""
    with (
        xmlrpc.client.ServerProxy(uri_of(server), headers=[("Origin", "null")]) as proxy,
        pytest.raises(xmlrpc.client.ProtocolError, match=r"403 .*web page"),
    ):
        proxy.getPid("/me")


def test_head_is_refused_without_a_body(server: XmlRpcServer) -> None:
    answer = say(server, b"HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n")
    assert answer.startswith(b"HTTP/1.1 405")
    assert answer.endswith(b"\r\n\r\n")


BOMB = b"""<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>
<methodCall><methodName>&b;</methodName><params/></methodCall>"""
