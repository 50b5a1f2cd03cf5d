"""What the client of XML-RPC tells of peers that answer nonsense, late or not at all."""

from __future__ import annotations

import socket
import threading
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.errors import TransportException
from rosmini.core.graph.scheduler import Scheduler
from rosmini.ros.net.io_thread import IoThread
from rosmini.ros.net.xmlrpc_client import XmlRpcClient

from ...processes import PATIENCE, free_port

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture
def client() -> Iterator[XmlRpcClient]:
    """A client with a thread of its own."""
    io = IoThread()
    yield XmlRpcClient(io, Scheduler())
    io.close()


def served(answer: bytes | None) -> Iterator[str]:
    """The URI of a peer that reads a call and answers these bytes; None: it never answers."""
    listener = socket.create_server(("127.0.0.1", 0))
    listener.settimeout(PATIENCE)
    held: list[Any] = []

    def answer_one() -> None:
        peer, _ = listener.accept()
        held.append(peer)
        peer.recv(65536)
        if answer is not None:
            peer.sendall(answer)
            peer.close()

    thread = threading.Thread(target=answer_one, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{listener.getsockname()[1]}/"
    thread.join(PATIENCE)
    for peer in held:
        peer.close()
    listener.close()


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (b"", "as a server of XML-RPC does|closed the connection"),
        (b"HTTP/1.1 500 Oh\r\nContent-Length: 0\r\n\r\n", "status 500"),
        (b"\x20\x00\x00\x00error=wrong port\r\n\r\n", "not answer hello as a server of XML-RPC does"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 3\r\n\r\nabc", "not XML-RPC"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 99999999999\r\n\r\n", "too long"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 50\r\n\r\nabc", "as a server of XML-RPC does"),
    ],
)
def test_nonsense_is_told_as_such(client: XmlRpcClient, answer: bytes, says: str) -> None:
    for uri in served(answer):
        with pytest.raises(TransportException, match=says):
            client.call(uri, "hello")


def test_a_peer_that_hangs_is_given_up(client: XmlRpcClient) -> None:
    for uri in served(None):
        with pytest.raises(TransportException, match=r"does not answer hello within 0\.1 s"):
            client.call(uri, "hello", timeout=0.1)


def test_an_answer_of_http_1_0_without_a_length_is_read_to_its_end(client: XmlRpcClient) -> None:
    document = b"<methodResponse><params><param><value><int>7</int></value></param></params></methodResponse>"
    for uri in served(b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n" + document):
        assert client.call(uri, "hello") == 7


@pytest.mark.parametrize(
    ("uri", "says"),
    [
        ("http://localhost:{port}/", "nothing can be reached at localhost:{port}: Connection refused"),
        ("http://no-such-host.invalid:1/", "does not resolve.*ROS_HOSTNAME"),
        ("localhost:11311", "should read http://host:port/"),
        ("http://localhost:port/", "should read http://host:port/"),
        ("", "should read http://host:port/"),
    ],
)
def test_wrong_addresses_are_told(client: XmlRpcClient, uri: str, says: str) -> None:
    port = free_port()
    with pytest.raises(TransportException, match=says.format(port=port)):
        client.call(uri.format(port=port), "hello")


@pytest.mark.parametrize("value", [None, 2**40, "\x00", object])
def test_values_that_xml_rpc_does_not_have_are_refused_here(client: XmlRpcClient, value: Any) -> None:
    with pytest.raises(TransportException):
        client.call(f"http://127.0.0.1:{free_port()}/", "setParam", value)


def test_waiting_calls_end_when_the_network_is_closed() -> None:
    scheduler, io = Scheduler(), IoThread()
    client = XmlRpcClient(io, scheduler)
    for uri in served(None):
        scheduler.call_at(scheduler.now_ns() + 1, io.close)
        with pytest.raises(TransportException, match="closed"):
            client.call(uri, "hello", timeout=PATIENCE)
