"""What is found out about nodes, from answers that real ones gave."""

from __future__ import annotations

import re
import socket
from types import SimpleNamespace
from typing import Any

import pytest

from rosmini.core.errors import ROSException, TransportException
from rosmini.ros.introspection import nodes

from ...tools.transcripts import FOLDER

INFO = (FOLDER / "rosnode_info_move_base.txt").read_text(encoding="utf-8")
NAME, URI = "/move_base", "http://127.0.0.1:33107/"


class MoveBase:
    """Master and nodes that answer what those of the transcript answered."""

    def __init__(self) -> None:
        head, tail = INFO.split("\ncontacting node ")
        parts = re.split(r"\n(?:Publications|Subscriptions|Services): \n", head)[1:]
        topics = [re.findall(r"^ \* (\S+)(?: \[(.*)\])?$", part, re.MULTILINE) for part in parts]
        self.kinds = [list(pair) for part in topics for pair in part if pair[1] not in ("", "unknown type")]
        self.links = [re.findall(r": (.*)", block) for block in re.split(r"^ \* topic", tail, flags=re.MULTILINE)[1:]]
        self.state = [[[name, [NAME]] for name, _ in part] for part in topics]
        self.uris = {NAME: URI}
        for topic, to, *_ in self.links:
            name, _, uri = to.partition(" ")
            if uri:
                self.uris[name] = uri.strip("()")
                next(row for row in self.state[1] if row[0] == topic)[1].append(name)
        self.transport = self

    def ask_as(self, _caller: str) -> Any:
        return self

    def ask(self, method: str, *_words: Any) -> Any:
        return {"getSystemState": self.state, "getPublishedTopics": self.kinds}[method]

    def find(self, _method: str, name: str) -> str | None:
        return self.uris.get(name)

    def call(self, uri: str, method: str, *_words: Any) -> list[Any]:
        assert uri == URI
        return [1, "", 5004 if method == "getPid" else [self.row(*link) for link in self.links]]

    @staticmethod
    def row(topic: str, to: str, direction: str, transport: str) -> list[Any]:
        ports = re.search(r"\((\d+) - (.*)\) \[(\d+)\]", direction)
        said = "{2} connection on port {0} to [{1} on socket {3}]" if ports else "INTRAPROCESS"
        text = said.format(ports[1], ports[2], "TCPROS", ports[3]) if ports else said
        uri = to.partition(" ")[2].strip("()")
        return [1, uri or to, direction[0], transport, topic, True, text]


def test_move_base_is_described_as_the_real_tool_does() -> None:
    peers: Any = MoveBase()
    about, contact = nodes.describe(peers, NAME), nodes.contact(peers, URI)
    assert (len(about.publications), len(about.subscriptions), len(about.services)) == (37, 10, 14)
    text = f"{'-' * 80}\n{about}\n\ncontacting node {URI} ...\n{contact}"
    assert text.split("Connections:", maxsplit=1)[0] == INFO.split("Connections:")[0]
    written = re.split(r"^ \* topic", INFO.rstrip("\n") + "\n", flags=re.MULTILINE)[1:]
    told = [str(link) for link in contact.links if "(http" in link.to]
    assert told == [f" * topic{block}" for block in written if "(http" in block]


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
