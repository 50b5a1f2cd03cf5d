"""A network that goes down and comes back between two nodes: both go on, and find each other again."""

from __future__ import annotations

import socket
import threading
from contextlib import suppress
from typing import TYPE_CHECKING

from rosmini.msgs.std_msgs.msg import String
from rosmini.ros.net.network import network_of
from rosmini.ros.net.xmlrpc_server import XmlRpcServer

from ...processes import PATIENCE
from .hostile import port_of, talk, until

if TYPE_CHECKING:
    from rosmini.core.graph import Graph


class Cable:
    """A way to a port of this machine that can be cut: then nothing passes, and nobody learns of it."""

    def __init__(self, target: int) -> None:
        self.is_up = threading.Event()
        self.is_up.set()
        self.count = 0
        self._target = target
        self._ends: list[socket.socket] = []
        self._threads: list[threading.Thread] = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        self._start(self._accept)

    def _start(self, work: object, *arguments: object) -> None:
        thread = threading.Thread(target=work, args=arguments, daemon=True)  # type: ignore[arg-type]
        self._threads.append(thread)
        thread.start()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                far = socket.create_connection(("127.0.0.1", self._target), timeout=PATIENCE)
                self._ends += [near, far]
                self.count += 1
                self._start(self._carry, near, far)
                self._start(self._carry, far, near)

    def _carry(self, source: socket.socket, target: socket.socket) -> None:
        with suppress(OSError):
            while data := source.recv(65536):
                self.is_up.wait(PATIENCE)
                target.sendall(data)
        for end in (source, target):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def break_connections(self) -> None:
        """Do what both systems do when nothing has been heard of the other for long."""
        for end in self._ends:
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """End it."""
        self.is_up.set()
        self.break_connections()
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        for thread in self._threads:
            thread.join(PATIENCE)
        for end in self._ends:
            end.close()


def test_a_network_that_goes_down_and_comes_back(graph: Graph) -> None:
    publisher, heard = talk(graph)
    cable = Cable(port_of(graph, "/talker"))
    slave = XmlRpcServer(network_of(graph).io, lambda *_: [1, "", ["TCPROS", "127.0.0.1", cable.port]])
    far: list[str] = []
    talker = graph.nodes["/talker"].publisher("/far", String, queue_size=100)
    graph.ask_as("/talker").ask("unregisterPublisher", "/far", graph.nodes["/talker"].uri)  # the way past the cable
    subscriber = graph.node("far").subscriber("/far", String, lambda message: far.append(message.data))
    graph.ask_as("/behind").ask("registerPublisher", "/far", String._type, f"http://127.0.0.1:{slave.port}/")
    until(graph, lambda: cable.count and subscriber.num_connections() == 1, "the way through the cable")
    until(graph, lambda: talker.num_connections() == 1, "its other end")
    talker.publish("before")
    until(graph, lambda: far == ["before"], "a message")

    cable.is_up.clear()
    for number in range(20):  # nobody who publishes waits for what does not pass
        talker.publish(f"lost or late {number}")
        publisher.publish(f"near {number}")
        until(graph, lambda number=number: heard[-1:] == [f"near {number}"], "what others hear")
    assert far == ["before"]
    assert subscriber.num_connections() == 1  # nobody has told it anything

    cable.is_up.set()  # a short break: all of it comes late
    until(graph, lambda: far[-1:] == ["lost or late 19"], "what was late")
    cable.is_up.clear()
    cable.break_connections()  # a long one
    until(graph, lambda: talker.num_connections() == 0, "the end of the connection")
    cable.is_up.set()
    until(graph, lambda: talker.num_connections() == 1 and subscriber.num_connections() == 1, "a new one")
    talker.publish("after")
    until(graph, lambda: far[-1:] == ["after"], "a message")
    graph.ask_as("/behind").ask("unregisterPublisher", "/far", f"http://127.0.0.1:{slave.port}/")
    slave.close()
    cable.close()
