"""Publishers that are none, or send what none should: one clear warning, and the others go on."""

from __future__ import annotations

import socket
import struct
import threading
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import pytest

from rosmini.core.graph import Graph
from rosmini.core.graph.headers import encode_header
from rosmini.core.graph.subscription import MAX_RETRY_S, RETRY_S
from rosmini.msgs.std_msgs.msg import Empty, String
from rosmini.ros.net import tcp_transport, xmlrpc_client
from rosmini.ros.net.network import network_of
from rosmini.ros.net.xmlrpc_server import XmlRpcServer
from rosmini.ros.rospy.msg import AnyMsg

from ...processes import PATIENCE, wait_until
from .hostile import RawServer, frame, unharmed, until

if TYPE_CHECKING:
    from collections.abc import Iterator

TOPIC = "/evil"
HEADER = {
    "callerid": "/raw",
    "latching": "0",
    "md5sum": String._md5sum,
    "message_definition": String._full_text,
    "topic": TOPIC,
    "type": String._type,
}
GOOD = frame(frame(b"good"))
LONG = struct.pack("<I", 2**32 - 1)


class RawPublisher(RawServer):
    """A node that publishes `/evil` and answers each connection with the same bytes."""

    def __init__(self, graph: Graph, answer: bytes | None, parameters: Any = None) -> None:
        super().__init__(*([] if answer is None else [answer]))
        if parameters is None:
            parameters = [1, "", ["TCPROS", "127.0.0.1", self.port]]
        self._slave = XmlRpcServer(network_of(graph).io, lambda *_: parameters)
        self.uri = f"http://127.0.0.1:{self._slave.port}/"

    def close(self) -> None:
        """End it."""
        self._slave.close()
        super().close()


@contextmanager
def publishing(graph: Graph, answer: bytes | None, parameters: Any = None) -> Iterator[RawPublisher]:
    """A raw publisher that the Master knows, for a while."""
    raw = RawPublisher(graph, answer, parameters)
    node = graph.ask_as("/raw")
    node.ask("registerPublisher", TOPIC, String._type, raw.uri)
    try:
        yield raw
    finally:
        node.ask("unregisterPublisher", TOPIC, raw.uri)
        raw.close()


@pytest.fixture
def delays(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """After how many seconds connections are made again; it is done at once, nine times."""
    found: list[float] = []

    transport = network_of(graph).transport
    really = transport.retry

    def retry(seconds: float, function: Any) -> bool:
        if function.func.__self__.topic != TOPIC:
            return really(seconds, function)
        found.append(seconds)
        if len(found) < 10:
            graph.scheduler.call_soon_threadsafe(function)
        return True

    monkeypatch.setattr(transport, "retry", retry)
    return found


ERROR = encode_header({"error": "not you"})


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (b"", "closed before its header came"),
        (b"\x10\x00", "closed before its header came"),
        (LONG, "not a node of ROS 1"),
        (b"HTTP/1.1 400 Bad Request\r\n\r\n", "HTTP"),
        (encode_header(HEADER) + LONG, "4294967295 bytes"),
        (encode_header(HEADER) + GOOD + LONG, "4294967295 bytes"),
        (encode_header(HEADER) + frame(b"\xff\xff\xff\xffgarbage"), "no std_msgs/String"),
        (encode_header(HEADER) + GOOD + frame(b""), "no std_msgs/String"),
        (encode_header(HEADER) + GOOD + frame(frame(b"and more") + b"junk"), "no std_msgs/String"),
    ],
)
def test_garbage_is_told_once_and_tried_again_ever_more_seldom(
    graph: Graph, delays: list[float], answer: bytes, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """As rospy does, the connection is dropped and made again; unlike there, not at once for ever."""
    heard: list[str] = []
    with unharmed(graph):
        subscriber = graph.node("victim").subscriber(TOPIC, String, lambda message: heard.append(message.data))
        with publishing(graph, answer) as raw:
            until(graph, lambda: raw.count == 10 and len(delays) == 10, "ten attempts")
        graph.nodes["/victim"].shutdown()
        assert not subscriber.num_connections()
    assert delays[:2] == [0.0, RETRY_S]
    assert delays[-1] == MAX_RETRY_S
    assert delays == sorted(delays)
    lines = [line for line in capsys.readouterr().err.splitlines() if "WARN" in line]
    assert len(lines) == 1, lines
    for word in ("/victim", TOPIC, says):
        assert word in lines[0]
    assert "/raw" in lines[0] or raw.uri in lines[0]
    assert set(heard) <= {"good"}


@pytest.mark.parametrize("answer", [encode_header(HEADER), encode_header(HEADER) + GOOD])
@pytest.mark.parametrize("cut", [b"", b"\x08", frame(frame(b"cut off"))[:-3]])
def test_a_publisher_that_closes_at_once_is_not_asked_all_the_time(
    graph: Graph, delays: list[float], answer: bytes, cut: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    """What was cut off is told, once."""
    with unharmed(graph):
        graph.node("victim").subscriber(TOPIC, String)
        with publishing(graph, answer + cut) as raw:
            until(graph, lambda: raw.count == 10 and len(delays) == 10, "ten attempts")
        graph.nodes["/victim"].shutdown()
    said = capsys.readouterr().err
    assert said.count(f"/victim lost a message on {TOPIC}: its publisher at 127.0.0.1:") == bool(cut)
    assert delays[0] == 0.0
    assert min(delays[1:]) == RETRY_S


@pytest.mark.parametrize(
    ("header", "says"),
    [
        ({"error": "not you"}, "refused the connection of /victim to /evil: not you"),
        ({"error": "not you", "md5sum": "1" * 32}, "not you"),
        ({"md5sum": "1" * 32, "type": "std_msgs/String"}, "The definitions differ"),
        ({"md5sum": "1" * 32, "type": "std_msgs/Int32", "message_definition": "int32 data"}, "+ string data"),
        ({"type": "std_msgs/String"}, "missing required field [md5sum]"),
        ({"md5sum": String._md5sum}, "missing required field [type]"),
        ({}, "missing required field"),
    ],
)
def test_who_refuses_or_is_of_another_type_is_told_with_what_differs(
    graph: Graph, header: dict[str, str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        graph.node("victim").subscriber(TOPIC, String)
        with publishing(graph, encode_header(header)):
            said: list[str] = []
            until(graph, lambda: said.append(capsys.readouterr().err) or says in "".join(said), says)
        graph.nodes["/victim"].shutdown()
    assert "".join(said).count("ERROR") == 1
    assert "Traceback" not in "".join(said)


@pytest.mark.parametrize("type_name", ["../../etc/passwd", "", "a/b/c", "no_such_pkg/Thing", "std_msgs/\x00", "*"])
def test_a_subscriber_of_any_type_meets_an_impossible_one(
    graph: Graph, type_name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    heard: list[Any] = []
    with unharmed(graph):
        graph.node("victim").subscriber(TOPIC, AnyMsg, heard.append)
        with publishing(graph, encode_header({**HEADER, "type": type_name}) + GOOD):
            until(graph, lambda: heard or "victim" in capsys.readouterr().err, "its word")
        graph.nodes["/victim"].shutdown()
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize(
    "answer",
    [
        0, "TCPROS", [1, 2], ["1", "", []], [1, "", 5], [1, "", "TCPROS"], [1, "", []], [1, "", ["TCPROS"]],
        [1, "", ["TCPROS", "127.0.0.1"]], [1, "", ["TCPROS", "127.0.0.1", "port"]],
        [1, "", ["TCPROS", "127.0.0.1", 2**31 - 1]], [1, "", ["TCPROS", "127.0.0.1", -1]],
        [1, "", ["TCPROS", "", 1]], [1, "", ["TCPROS", "a b", 1]], [1, "", ["TCPROS", "." * 70, 1]],
        [1, "", ["UDPROS", "127.0.0.1", 1, 2, 1500, b""]], [1, "", [["TCPROS"], {}]], [0, {"not": "text"}, []],
    ],
)  # fmt: skip
def test_nonsense_as_an_answer_to_request_topic(
    graph: Graph, delays: list[float], answer: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    with unharmed(graph):
        graph.node("victim").subscriber(TOPIC, String)
        with publishing(graph, None, answer):
            said: list[str] = []
            until(graph, lambda: said.append(capsys.readouterr().err) or "/victim" in "".join(said), "a word")
            until(graph, lambda: not graph.nodes["/victim"].subscriptions[TOPIC].connections, "its end")
        graph.nodes["/victim"].shutdown()
    text = "".join(said)
    assert text.count("[WARN]") + text.count("[ERROR]") == 1, text
    assert TOPIC in text
    assert "Traceback" not in text


def test_a_publisher_that_shows_no_header_is_given_up(
    graph: Graph, delays: list[float], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tcp_transport, "CONNECT_S", 0.1)
    with unharmed(graph):
        graph.node("victim").subscriber(TOPIC, String)
        with publishing(graph, None):
            until(graph, lambda: len(delays) == 10, "ten attempts")
        graph.nodes["/victim"].shutdown()
    # On a busy machine a sound one may take longer than that, too.
    told = [line for line in capsys.readouterr().err.splitlines() if "does not answer within" in line]
    assert len([line for line in told if f"publishes {TOPIC} " in line]) == 1


def test_a_publisher_whose_slave_api_hangs_is_told(
    graph: Graph, delays: list[float], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(xmlrpc_client.XmlRpcClient.call.__kwdefaults__, "timeout", 0.1)
    with unharmed(graph), socket.create_server(("127.0.0.1", 0)) as silent:
        graph.node("victim").subscriber(TOPIC, String)
        uri = f"http://127.0.0.1:{silent.getsockname()[1]}/"
        graph.ask_as("/raw").ask("registerPublisher", TOPIC, String._type, uri)
        until(graph, lambda: len(delays) == 10, "ten attempts")
        graph.ask_as("/raw").ask("unregisterPublisher", TOPIC, uri)
        graph.nodes["/victim"].shutdown()
    # On a busy machine a sound one may take longer than that, too.
    told = [line for line in capsys.readouterr().err.splitlines() if "does not answer requestTopic" in line]
    assert len([line for line in told if uri in line]) == 1, told


def test_a_flood_of_empty_messages_waits_outside(graph: Graph) -> None:
    """Also where nothing in them counts as bytes."""
    header = {**HEADER, "md5sum": Empty._md5sum, "type": Empty._type, "message_definition": ""}
    subscriber = graph.node("victim").subscriber(TOPIC, Empty, lambda _: None)
    with publishing(graph, None) as raw:
        until(graph, lambda: raw.count == 1, "a subscriber")
        raw.open[0].sendall(encode_header(header))
        until(graph, subscriber.num_connections, "a connection")

        def flood() -> None:
            with suppress(OSError):
                for _ in range(500):
                    raw.open[0].sendall(b"\x00" * 65536)

        thread = threading.Thread(target=flood, daemon=True)
        thread.start()
        (connection,) = graph.nodes["/victim"].subscriptions[TOPIC].connections.values()
        inlet = connection._close_link.__self__
        wait_until(lambda: inlet._is_paused, "a pause of reading")
        assert thread.is_alive()
        graph.nodes["/victim"].shutdown()
        thread.join(PATIENCE)
