"""Checks of the exercises in the chapter The wire."""

from __future__ import annotations

import math
import socket
import struct
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from typing import Any

from rosmini.book.checks import Wrong, exercise, expect, expect_type
from rosmini.core.graph import Graph
from rosmini.core.graph.headers import encode_header
from rosmini.core.graph.local_transport import LocalTransport
from rosmini.msgs.geometry_msgs.msg import Twist
from rosmini.msgs.sensor_msgs.msg import LaserScan
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.net.network import tcp
from rosmini.ros.scripts import rosrun

# ---- fields_of: a header ----

HEADERS: tuple[dict[str, str], ...] = (
    {"callerid": "/talker", "latching": "0", "topic": "/chatter", "type": "std_msgs/String"},
    {"callerid": "/a", "message_definition": "int8 A=1\nint8 x\n\n" + "=" * 80 + "\nMSG: b/C\n"},
    {"topic": "/t\u00fcr", "empty": ""},
    {},
)


@exercise("fields_of", praise="Every ROS node reads a header like this before it accepts a connection.")
def fields_of(answer: Any) -> None:
    """The fields of a connection header, without its total length."""
    for fields in HEADERS:
        found = answer(encode_header(fields)[4:])
        expect_type(found, dict, "It returned", "a dictionary")
        expect(
            all(isinstance(one, str) for pair in found.items() for one in pair),
            "Not all names and values are strings.",
            "convert bytes with decode()",
        )
        for name, value in fields.items():
            expect(name in found, f"The field {name} is missing.", "continue where the last field ended")
            expect(
                found[name] == value,
                f"The field {name} is {found[name]!r:.60}, not {value!r:.60}.",
                "split only at the first = of a field; a length counts bytes, not letters",
            )
        expect(set(found) == set(fields), f"There are extra fields: {', '.join(set(found) - set(fields))}.")
    for broken in (encode_header(HEADERS[0])[4:-1], struct.pack("<I", 50) + b"topic=/scan", b"\x01\x00"):
        try:
            answer(broken)
        except ValueError:
            continue
        except Exception as error:
            raise Wrong(f"For a truncated header it raised {type(error).__name__}.") from error
        raise Wrong("It accepted a header that is truncated or has a wrong length.", "raise ValueError")


# ---- culprits: refusals ----


@exercise("culprits", praise="The name of a type is for people; nodes compare the md5 sum.")
def culprits(answer: Any) -> None:
    """The fields because of which three connections were refused."""
    expect_type(answer, list | tuple, "culprits is", "a list")
    expect(len(answer) == 3, f"culprits has {len(answer)} entries, not three.")
    hints = (
        "does this node publish the requested topic?",
        "read the answer: a field is missing",
        "the publisher compares only one field, and it is not the name of the type",
    )
    for number, (given, right, hint) in enumerate(zip(answer, ("topic", "md5sum", "md5sum"), hints, strict=True), 1):
        expect(given == right, f"Connection {number} was not refused because of {given}.", hint)


# ---- hear: a subscriber ----

TURNS = 2_000
"""Number of reads without data after which the check reports an endless loop."""


class _Trickle:
    """A socket for the reader: it drives the graph, and returns only a few bytes at a time."""

    def __init__(self, sock: socket.socket, graph: Graph, say: Callable[[], object]) -> None:
        self._socket, self._graph, self._say = sock, graph, say
        self._turns = 0
        sock.settimeout(0.01)

    def sendall(self, data: bytes) -> None:
        self._socket.sendall(data)

    def recv(self, count: int) -> bytes:
        while self._turns < TURNS:
            self._turns += 1
            self._graph.run(0)
            try:
                data = self._socket.recv(min(count, 3))
            except TimeoutError:
                self._say()
                continue
            if not data:
                self._turns += TURNS // 10
            return data
        raise Wrong("Your program waits for bytes that never arrive.", "recv returns b'' when the other end closes")

    def close(self) -> None:
        self._socket.close()


@contextmanager
def _online() -> Iterator[tuple[Graph, Callable[[tuple[str, int]], _Trickle], list[_Trickle]]]:
    """Yield a graph with a talker on TCP, a function that connects to it, and the open sockets."""
    opened: list[_Trickle] = []
    with Graph(transports=[LocalTransport, tcp()]) as graph:
        news = graph.node("announcer").publisher("/news", String, queue_size=10)
        graph.run(0.1)

        def say() -> None:
            if news.num_connections():
                news.publish("extra")

        def connect(address: tuple[str, int]) -> _Trickle:
            opened.append(_Trickle(socket.create_connection(address), graph, say))
            return opened[-1]

        try:
            yield graph, connect, opened
        finally:
            for one in opened:
                one.close()


class _Master:
    """The Master's proxy for the reader; it records registrations."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self.asked: list[tuple[Any, ...]] = []

    def __getattr__(self, method: str) -> Any:
        def call(*arguments: Any) -> Any:
            self.asked.append((method, *arguments))
            return getattr(self._graph.master, method)(*arguments)

        return call


@exercise("hear", praise="You wrote a working ROS 1 subscriber from sockets alone.")
def hear(answer: Any) -> None:
    """A subscriber made of sockets."""
    with _online() as (graph, connect, opened):
        master = _Master(graph)
        try:
            heard = answer(master, connect, "/news", String._type, String._md5sum)
        except struct.error as error:
            raise Wrong(
                f"A partial read was treated as the whole message: {error}.",
                "recv(n) may return fewer than n bytes: repeat it until you have n",
            ) from error
        expect(
            ("registerSubscriber", "/ear", "/news", String._type) in [one[:4] for one in master.asked],
            "/ear did not register as a subscriber to the topic.",
            "call master.registerSubscriber(name, topic, type, address)",
        )
        expect(opened, "It opened no connection.", "call sock = connect((host, port))")
        expect_type(heard, bytes, "It returned", "the bytes of the message")
        expect(
            heard == struct.pack("<I", 5) + b"extra",
            f"It returned {heard!r:.60}, not the bytes of the message.",
            "the first frame is the publisher's header, the second the message; read both completely",
        )
    with redirect_stdout(StringIO()), redirect_stderr(StringIO()), _online() as (graph, connect, _):
        try:  # the publisher's log is of no interest to the reader
            answer(_Master(graph), connect, "/news", String._type, "0" * 32)
        except ConnectionRefusedError:
            return
        raise Wrong("It did not raise ConnectionRefusedError for a wrong md5 sum.", "look for b'error='")


# ---- decide: stop, in bytes ----


STOPS = (2.7, 2.95)
"""Range of the robot's final position [m]: the wall is at 3.3 m, and a scan is up to 0.2 s old."""


@exercise("decide", praise="The robot stopped in front of the wall, controlled by nothing but bytes.")
def decide(answer: Any) -> None:
    """The bytes that the reader's function returns make a robot drive and stop in front of the wall."""
    clear = LaserScan(ranges=[3.0] * 360)
    clear.header.frame_id = "base_scan"
    frame = answer(clear._encode(clear))
    expect_type(frame, bytes, "It returned", "bytes")
    expect(len(frame) == 52, f"The frame has {len(frame)} bytes, not 52.", "a length, and six numbers of 8 bytes")
    expect(struct.unpack_from("<I", frame)[0] == 48, "The length of the frame is not 48.", 'use pack("<I6d", ...)')
    with Graph() as graph:
        sim = rosrun("rosmini_sim", "simulator", "_world:=room", "_noise:=0", graph=graph).instance()
        node = graph.node("by_hand")
        wheels = node.publisher("cmd_vel", Twist, queue_size=1)

        def drive(scan: Any) -> None:
            wheels.publish(Twist._decode(answer(scan._encode(scan))[4:]))

        node.subscriber("scan", LaserScan, drive, queue_size=1)
        graph.run(20.0)
        x, y, heading = sim.truth()
        graph.run(1.0)
        stands = math.isclose(sim.truth()[0], x, abs_tol=1e-3)
    expect(x > 0.1, "The robot did not drive.", "linear.x is the first of the six numbers")
    expect(abs(y) < 0.1 and abs(heading) < 0.2, "The robot did not go straight ahead.", "set only linear.x")
    expect(stands, "The robot is still driving after twenty seconds.", "return zeros at 0.5 m ahead or less")
    expect(
        STOPS[0] < x < STOPS[1],
        f"The robot stopped after {x:.2f} m; to be half a metre from the wall, it should stop after about 2.8 m.",
        "compare the distance ahead with 0.5",
    )
