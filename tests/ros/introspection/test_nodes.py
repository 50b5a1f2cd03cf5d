"""What is found out about nodes, from answers that real ones gave."""

from __future__ import annotations

import socket
from types import SimpleNamespace
from typing import Any

import pytest

from rosmini.core.errors import ROSException, TransportException
from rosmini.ros.introspection import nodes


def test_connections_of_older_clients_count_as_open_and_closed_ones_are_left_out() -> None:
    rows = [[1, "/a", "o", "TCPROS", "/t"], [2, "/b", "x", "UDPROS", "/u", True], [3, "/c", "i", "TCPROS", "/v", False]]
    answers = {"getPid": [1, "", 7], "getBusInfo": [1, "", rows]}
    peers: Any = SimpleNamespace(
        ask_as=lambda _: SimpleNamespace(ask=lambda *_: [[], [], []]),
        transport=SimpleNamespace(call=lambda _, method, *__: answers[method]),
    )
    found = nodes.contact(peers, "http://x:1/")
    assert [(link.to, link.direction) for link in found.links] == [("/a", "outbound"), ("/b", "unknown")]
    answers["getPid"] = [-1, "go away", 0]
    with pytest.raises(ROSException, match="remote call failed: go away"):
        nodes.contact(peers, "http://x:1/")


SILENT = [
    (TimeoutError("timed out"), "connection to [/n] timed out"),
    (socket.gaierror(-2, "unknown"), "ERROR: Unknown host [robot] for node [/n]"),
    (ConnectionRefusedError(111, "refused"), "ERROR: connection refused to [http://robot:1/]"),
    (None, "ERROR: connection refused to [http://robot:1/]"),
    (OSError(113, "no route"), "connection to [/n] failed"),
]


@pytest.mark.parametrize(("cause", "says"), SILENT)
def test_why_a_node_is_silent(cause: Exception | None, says: str) -> None:
    error = TransportException("no answer")
    error.__cause__ = cause
    assert nodes.why_silent(error, "/n", "http://robot:1/") == says
