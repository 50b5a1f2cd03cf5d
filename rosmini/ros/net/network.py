"""The network side of a graph: one I/O thread, an XML-RPC client, and the transport of its nodes."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError
from rosmini.core.graph.rosout import LogGates

from .addresses import HERE
from .io_thread import IoThread
from .tcp_transport import TcpTransport
from .xmlrpc_client import XmlRpcClient

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosmini.core.graph.graph import Graph
    from rosmini.core.graph.scheduler import Scheduler

    from .addresses import Addresses


WARN_NS = 60_000_000_000
"""How long repeated warnings about the same fault of a peer are suppressed [ns]."""

MAX_WARNING_LENGTH = 500


class Network:
    """The network of one graph; nothing runs until a node or a call needs it.

    Args:
        scheduler: the scheduler of the graph.
        where: the addresses of this process: the advertised one, and the one to listen on.

    """

    def __init__(self, scheduler: Scheduler, where: Addresses = HERE) -> None:
        self.scheduler = scheduler
        self.where = where
        self.io = IoThread(scheduler)
        self.client = XmlRpcClient(self.io, scheduler)
        self._gates = LogGates()
        self.transport = TcpTransport(self)

    def warn(self, text: str, cause: tuple[str, ...] = ()) -> None:
        """Warn about a fault of a peer outside this graph; may be called from any thread.

        With a ``cause``, such as the node, the peer's host and the fault, the warning appears once a minute. Text from
        the peer is shown on one line, without terminal control characters.
        """
        if cause and not self._gates.is_due(cause, time.monotonic_ns(), WARN_NS):
            return
        line = "".join(letter if letter.isprintable() else "?" for letter in text[:MAX_WARNING_LENGTH])
        sys.stderr.write(f"[WARN] {line}{'...' if len(text) > MAX_WARNING_LENGTH else ''}\n")

    def close(self) -> None:
        """End the I/O thread and close what is open, within two seconds; it restarts on the next use."""
        self.io.close()


def tcp(where: Addresses = HERE) -> Callable[[Scheduler], TcpTransport]:
    """Return a factory of transports for ``Graph(transports=[LocalTransport, ...])``; see :class:`Network`."""
    return lambda scheduler: Network(scheduler, where).transport


def network_of(graph: Graph) -> Network:
    """Return the network of a graph. Raises ``RosminiError`` if it has none."""
    for transport in graph.transport.transports:
        if isinstance(transport, TcpTransport) and isinstance(transport.network, Network):
            return transport.network
    msg = "this graph has no network: make it with Graph(transports=[LocalTransport, rosmini.ros.net.network.tcp()])"
    raise RosminiError(msg)
