"""What the tests of hostile and tired peers share: raw sockets at our ports, and a count of what a process holds."""

from __future__ import annotations

import asyncio
import os
import socket
import struct
import threading
import time
from collections import Counter
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosmini.core.graph.headers import encode_header
from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.net.network import network_of

from ...processes import PATIENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rosmini.core.graph import Graph


def until(graph: Graph, condition: Callable[[], object], what: str = "what was awaited") -> None:
    """Drive a graph until a condition holds, of this thread or of another one."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, f"waited in vain for {what}"
        graph.run(0.01)


def port_of(graph: Graph, name: str) -> int:
    """The port of a node for topics and services."""
    return int(network_of(graph).transport.service_uri(graph.nodes[name].uri).rpartition(":")[2])


def slave_port_of(graph: Graph, name: str) -> int:
    """The port of a node's slave API."""
    return int(graph.nodes[name].uri.rstrip("/").rpartition(":")[2])


def at(port: int) -> socket.socket:
    """A socket that is connected to a port of this machine."""
    return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)


def has_ended(raw: socket.socket) -> bool:
    """Whether the other end has closed a connection, from which nothing else is read."""
    try:
        return raw.recv(100) == b""
    except BlockingIOError:
        return False
    except ConnectionError:
        return True


def say(graph: Graph, port: int, *parts: bytes, finish: bool = False) -> bytes:
    """Send bytes to a port, drive the graph, and return the answer until the other end closes."""
    got: list[bytes] = []

    def peer() -> None:
        answer = b""
        with suppress(ConnectionError), at(port) as raw:
            for part in parts:
                raw.sendall(part)
            if finish:
                with suppress(OSError):  # the other end may have closed it: ENOTCONN is no ConnectionError
                    raw.shutdown(socket.SHUT_WR)
            while part := raw.recv(65536):
                answer += part
        got.append(answer)

    thread = threading.Thread(target=peer, daemon=True)
    thread.start()
    until(graph, lambda: got, "the end of a connection")
    thread.join(PATIENCE)
    return got[0]


def subscribing(topic: str = "/t", **fields: str) -> bytes:
    """The header of a proper subscriber of any type."""
    return encode_header({"callerid": "/raw", "topic": topic, "md5sum": "*", "type": "*", **fields})


def frame(body: bytes) -> bytes:
    """Bytes with their length in front."""
    return struct.pack("<I", len(body)) + body


def talk(graph: Graph) -> tuple[Any, list[str]]:
    """A publisher of `/t` and what its subscriber hears; both ends of every connection of the graph are open."""
    heard: list[str] = []
    graph.node("listener").subscriber("t", String, lambda message: heard.append(message.data))
    publisher = graph.node("talker").publisher("t", String, queue_size=100)
    until(graph, lambda: _is_connected(graph), "all connections")
    return publisher, heard


def _is_connected(graph: Graph) -> bool:
    """Whether each publisher and each subscriber of the graph's nodes has its connections, those of `/rosout` too.

    A connection that is still being made when `Held` counts for the first time looks like one that is left behind.
    """
    nodes = list(graph.nodes.values())
    published = Counter(topic for node in nodes for topic in node.publications)
    subscribed = Counter(topic for node in nodes for topic in node.subscriptions)
    return all(
        len(publication.senders) == subscribed[topic]
        for node in nodes
        for topic, publication in node.publications.items()
    ) and all(
        subscription.num_open() == published[topic]
        for node in nodes
        for topic, subscription in node.subscriptions.items()
    )


class Held:
    """What this process holds for a graph's network: threads, descriptors, tasks, and what would have to be closed."""

    def __init__(self, graph: Graph) -> None:
        io = network_of(graph).io
        self._loop, self._closers = io.loop, io.closers

    def count(self) -> dict[str, int]:
        """Count it."""
        return {
            "threads": threading.active_count(),
            "descriptors": _descriptors(),
            "tasks": len(asyncio.all_tasks(self._loop)),
            "to close": len(self._closers),
        }


def _descriptors() -> int:
    folder = Path("/proc/self/fd")
    return len(os.listdir(folder)) if folder.is_dir() else 0


@contextmanager
def unharmed(graph: Graph) -> Iterator[tuple[Any, list[str]]]:
    """Check that what happens inside leaves nothing behind, and that messages go from `/talker` to `/listener` then.

    Yield that publisher, and what `/listener` hears.
    """
    publisher, heard = talk(graph)
    network = network_of(graph)
    network.client.call(graph.nodes["/talker"].uri, "getPid", "/test")  # this connection is kept, with its task
    held = Held(graph)
    publisher.publish("first")
    until(graph, lambda: heard == ["first"], "a message")  # so both ends are known to be open
    del heard[:]
    before = held.count()
    yield publisher, heard
    try:
        until(graph, lambda: all(now <= before[what] for what, now in held.count().items()))
    except AssertionError:
        raise AssertionError(f"it held {before}, and now {held.count()}") from None
    publisher.publish("still here")
    until(graph, lambda: "still here" in heard, "a message")


class RawServer:
    """Listens at a port of this machine, for one connection at a time.

    What each says first is answered with the first of some bytes, and so on, and then it is closed; without any it is
    held, and nothing is said.
    """

    def __init__(self, *answers: bytes) -> None:
        self.count = 0
        self.open: list[socket.socket] = []
        self._answers = answers
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        with suppress(OSError):
            while True:
                peer, _ = self._listener.accept()
                self.open.append(peer)
                with suppress(OSError):
                    for answer in self._answers:
                        peer.recv(65536)
                        peer.sendall(answer)
                    if self._answers:
                        peer.shutdown(socket.SHUT_WR)
                self.count += 1

    def close(self) -> None:
        """End it."""
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        for peer in self.open:
            with suppress(OSError):
                peer.shutdown(socket.SHUT_RDWR)
        self._thread.join(PATIENCE)
        for peer in self.open:
            peer.close()
