"""What holds for each connection, at both ends of it."""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING

import pytest

from rosmini.core.graph import Graph
from rosmini.msgs.std_srvs.srv import Empty
from rosmini.ros.net.sockets import KEEPALIVE
from rosmini.ros.net.tcp_transport import TcpTransport

from .hostile import until

if TYPE_CHECKING:
    from collections.abc import Iterator


def connections() -> Iterator[tuple[tuple[str, int], socket.socket]]:
    """The connected sockets of this process over IPv4, by their peers' addresses; /proc lists them."""
    for number in os.listdir("/proc/self/fd"):
        try:
            if not os.readlink(f"/proc/self/fd/{number}").startswith("socket:"):
                continue  # a duplicate of a pipe would stay open: `tests/processes.py` waits for the end of one
            found = socket.socket(fileno=os.dup(int(number)))
        except OSError:  # it was closed meanwhile
            continue
        with found:
            if found.family == socket.AF_INET and found.type == socket.SOCK_STREAM:
                try:
                    yield found.getpeername(), found
                except OSError:  # it listens
                    continue


@pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="looks for sockets in /proc")
def test_both_ends_of_a_connection_notice_that_the_other_host_is_gone(graph: Graph) -> None:
    server, caller = graph.node("server"), graph.node("caller")
    server.service("ping", Empty, lambda _: Empty._response_class())
    client = caller.service_client("ping", Empty, persistent=True)
    answers: list[object] = []
    caller.run(lambda: answers.append(client()))
    until(graph, lambda: answers, "an answer")
    transport = graph.transport.transports[0]
    assert isinstance(transport, TcpTransport)
    port = int(transport.service_uri(server.uri).rpartition(":")[2])
    ends = [
        (
            end.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE),
            {name: end.getsockopt(socket.IPPROTO_TCP, getattr(socket, name)) for name in KEEPALIVE},
        )
        for peer, end in connections()
        if port in (peer[1], end.getsockname()[1])
    ]
    assert len(ends) >= 2
    assert ends == [(1, KEEPALIVE)] * len(ends)
