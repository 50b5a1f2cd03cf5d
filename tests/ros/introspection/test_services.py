"""What services there are, asked of a Master and of servers; hostile servers among them."""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from rosmini import Graph
from rosmini.core.errors import TransportException
from rosmini.core.graph.headers import decode_header, encode_header
from rosmini.msgs.std_srvs.srv import Empty, Trigger
from rosmini.ros.introspection import services
from rosmini.ros.introspection.direct import DirectWire

from ...processes import free_port


def test_services_of_a_graph() -> None:
    with Graph() as graph:
        node = graph.node("robot", namespace="/a")
        node.service("start", Trigger, lambda _: (True, ""))
        node.service("/stop", Empty, lambda _: ())
        within = services.services(graph, "/a")
        assert services.Service("/a/start", ("/a/robot",)) in within
        assert all(each.name.startswith("/a/") for each in within)
        assert services.type_of(graph, "/a/start") == "std_srvs/Trigger"
        assert services.type_of(graph, "/none") is None
        assert services.node_of(graph, "/stop") == "/a/robot"
        assert services.by_type(graph, "std_srvs/Empty") == ["/stop"]
        uri = services.uri_of(graph, "/stop")
        assert uri is not None
        told = services.headers(graph, "/stop", uri)
        assert (told["callerid"], told["md5sum"]) == ("/a/robot", Empty._md5sum)
        assert services.what_next(graph, "/stpo") == "did you mean /stop?"
        with pytest.raises(TransportException):
            services.headers(graph, "/nothing_there", uri)


@contextmanager
def serving(answer: bytes) -> Iterator[tuple[str, list[bytes]]]:
    """A server that answers one connection with bytes; yields its address, and what it hears."""
    heard: list[bytes] = []
    with socket.create_server(("127.0.0.1", 0)) as server:

        def serve() -> None:
            wire, _ = server.accept()
            with wire:
                heard.append(wire.recv(65536))
                wire.sendall(answer)

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield f"rosrpc://127.0.0.1:{server.getsockname()[1]}", heard
        finally:
            thread.join()


def test_a_server_elsewhere_is_asked_for_its_header() -> None:
    header = {"type": "std_srvs/Empty", "callerid": "/far"}
    with serving(encode_header(header)) as (uri, heard), DirectWire("http://127.0.0.1:1") as wire:
        assert wire.probe_service(uri, {"probe": "1", "service": "/x"}) == header
    assert decode_header(heard[0]) == {"probe": "1", "service": "/x"}


@pytest.mark.parametrize(
    "answer",
    [b"", b"\x01\x02", struct.pack("<I", 2**31), struct.pack("<I", 9) + b"abc", struct.pack("<I", 4) + b"\xff" * 4],
)
def test_a_server_that_answers_nonsense(answer: bytes) -> None:
    with (
        serving(answer) as (uri, _),
        DirectWire("http://127.0.0.1:1") as wire,
        pytest.raises(TransportException, match="no answer from the service"),
    ):
        wire.probe_service(uri, {"probe": "1"})


@pytest.mark.parametrize("uri", ["rosrpc://127.0.0.1:99999", "nonsense", "rosrpc://[::1", "rosrpc://127.0.0.1:{}"])
def test_an_address_at_which_nobody_is(uri: str) -> None:
    with DirectWire("http://127.0.0.1:1") as wire, pytest.raises(TransportException, match="no answer"):
        wire.probe_service(uri.format(free_port()), {"probe": "1"})
