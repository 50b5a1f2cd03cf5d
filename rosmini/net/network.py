"""What a graph has of the network: one I/O thread, a client of XML-RPC, and the transport of its nodes."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from rosmini.errors import RosminiError

from .io_thread import IoThread
from .tcp_transport import TcpTransport
from .xmlrpc_client import XmlRpcClient

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.graph.graph_core import GraphCore
    from rosmini.graph.scheduler import Scheduler


class Network:
    """The network of one graph. Nothing runs until a node, or a call, needs it.

    Args:
        scheduler: the graph's.
        host: the name or address that others are told.
        bind: the address at which nodes listen. Both may be changed: nodes that come later have the new ones.

    """

    def __init__(self, scheduler: Scheduler, *, host: str = "localhost", bind: str = "127.0.0.1") -> None:
        self.scheduler = scheduler
        self.host = host
        self.bind = bind
        self.io = IoThread()
        self.client = XmlRpcClient(self.io, scheduler)
        self.transport = TcpTransport(self)

    def warn(self, text: str) -> None:
        """Say what went wrong with a peer that is no node of this graph. From any thread."""
        sys.stderr.write(f"[WARN] {text}\n")

    def close(self) -> None:
        """End the I/O thread and close what is open, within two seconds; what is used again begins anew."""
        self.io.close()


def tcp(host: str = "localhost", bind: str = "127.0.0.1") -> Callable[[Scheduler], TcpTransport]:
    """Return what makes a transport for ``Graph(transports=[LocalTransport, ...])``; see :class:`Network`."""
    return lambda scheduler: Network(scheduler, host=host, bind=bind).transport


def network_of(graph: GraphCore) -> Network:
    """Return the network of a graph. Raises ``RosminiError`` if it has none."""
    for way in graph.transport.ways:
        if isinstance(way, TcpTransport) and isinstance(way.network, Network):
            return way.network
    msg = "this graph has no network: make it with Graph(transports=[LocalTransport, rosmini.net.network.tcp()])"
    raise RosminiError(msg)
