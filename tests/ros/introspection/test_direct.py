"""Asking a Master elsewhere: what it answers, and what goes wrong."""

from __future__ import annotations

import threading
import xmlrpc.client
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from typing import Any

import pytest

from rosmini.core.errors import MasterUnreachable, ROSException, TransportException
from rosmini.ros.introspection import direct, nodes
from rosmini.ros.introspection.direct import DirectWire

from ...processes import free_port


@contextmanager
def answering(answer: Callable[[bytes], bytes], status: int = 200) -> Iterator[str]:
    """A server that answers every request with XML; yields its address."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = answer(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(status)
            self.send_header("Content-Type", "text/xml")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_words: Any) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=lambda: server.serve_forever(0.01))
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()
            thread.join()


def triple(*values: Any) -> bytes:
    return xmlrpc.client.dumps((list(values),), methodresponse=True).encode()


def test_a_master_is_asked_in_somebodys_name() -> None:
    asked: list[Any] = []

    def answer(body: bytes) -> bytes:
        asked.append(xmlrpc.client.loads(body))
        return triple(*({"lookupNode": (-1, "unknown node", 0)}.get(asked[-1][1], (1, "", [["/t", "std_msgs/Empty"]]))))

    with answering(answer) as uri:
        wire = DirectWire(uri)
        master = wire.ask_as("/me")
        assert master.ask("getTopicTypes") == [["/t", "std_msgs/Empty"]]
        assert master.find("lookupNode", "/x") is None
        with pytest.raises(ROSException, match="refused lookupNode of /me: unknown node"):
            master.ask("lookupNode", "/x")
        assert nodes.uri_of(wire, "/x") is None
    assert asked[0] == (("/me",), "getTopicTypes")
    assert asked[1] == (("/me", "/x"), "lookupNode")


BOMB = b"""<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
<methodResponse><params><param><value>&b;</value></param></params></methodResponse>"""
HOSTILE = [
    (BOMB, "declares a document type"),
    (b"<methodResponse>", "no element found"),
    (b"this is no XML", "syntax error"),
    (triple(1, "two"), "which no ROS program does"),
    (xmlrpc.client.dumps(xmlrpc.client.Fault(3, "no such method")).encode(), "no such method"),
    (b"<methodResponse>" + b" " * 2000 + b"</methodResponse>", "more than 1,000 bytes"),
]


@pytest.mark.parametrize(("body", "says"), HOSTILE, ids=[says for _, says in HOSTILE])
def test_what_no_ros_program_answers(body: bytes, says: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(direct, "MAX_BYTES", 1000)
    with answering(lambda _: body) as uri:
        with pytest.raises(TransportException, match=says):
            DirectWire(uri).call(uri, "getPid", "/me")
        with pytest.raises(MasterUnreachable, match=says):
            DirectWire(uri).ask_as("/me").ask("getPid")


def test_nobody_is_there() -> None:
    uri = f"http://127.0.0.1:{free_port()}/"
    with pytest.raises(TransportException, match=f"no answer from {uri}: ") as caught:
        DirectWire(uri).call(uri, "getPid", "/me")
    assert nodes.why_silent(caught.value, "/n", uri) == f"ERROR: connection refused to [{uri}]"
    with pytest.raises(MasterUnreachable, match=r"the Master at .* does not answer: .*rosmini roscore"):
        DirectWire(uri).ask_as("/me").find("lookupNode", "/x")


def test_why_there_is_no_master_and_what_to_do() -> None:
    with pytest.raises(MasterUnreachable, match=r"name 'no-such-host.invalid' does not resolve.*/etc/hosts"):
        DirectWire("http://no-such-host.invalid:11311").ask_as("/me").ask("getPid")
    with (
        answering(lambda _: b"no page", 404) as uri,
        pytest.raises(MasterUnreachable, match=r"is not a ROS Master: it answered with HTTP status 404"),
    ):
        DirectWire(uri).ask_as("/me").ask("getPid")


@pytest.mark.parametrize("uri", ["ftp://localhost:1/", "localhost", "http://[::1", "http://no host:1/"])
def test_what_is_no_address(uri: str) -> None:
    with pytest.raises(TransportException, match="no answer from"):
        DirectWire(uri).call(uri, "getPid", "/me")


def test_a_node_that_hangs_times_out() -> None:
    free = threading.Event()

    def hang(_body: bytes) -> bytes:
        free.wait()
        return triple(1, "", 1)

    with answering(hang) as uri:
        try:
            with pytest.raises(TransportException, match="timed out") as caught:
                DirectWire("http://localhost:1/", node_s=0.05).call(uri, "getPid", "/me")
        finally:
            free.set()
    assert nodes.why_silent(caught.value, "/n", uri) == "connection to [/n] timed out"


def test_the_clock_on_the_wall() -> None:
    clock = DirectWire("http://localhost:1/").scheduler
    start = clock.now_ns()
    clock.sleep_until(start + 1_000_000)
    assert clock.now_ns() >= start + 1_000_000
    clock.sleep_until(start)
