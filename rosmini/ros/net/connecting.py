"""A graph of this process that is part of the one of a Master: what a node or a tool in a terminal uses."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from rosmini.core.graph import Graph
from rosmini.core.graph.transport import LocalTransport

from .addresses import addresses
from .network import network_of, tcp
from .remote_master import RemoteMaster
from .watch import Watch

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


def connect(
    environ: Mapping[str, str] | None = None,
    arguments: Mapping[str, str] | None = None,
    *,
    rate: float = 1.0,
    seed: int = 0,
    log_dir: str | Path | None = None,
    announce: bool = True,
) -> Graph:
    """Return a graph in wall time whose nodes are citizens of the graph of the Master that the environment names.

    Nothing is asked of the Master yet: it may come later. Nodes of this process exchange messages directly, all others
    over TCPROS. A process that listens on the network, or whose addresses are wrong, says so on standard error.
    ``shutdown`` of the graph (or the end of its ``with``) ends what belongs to it on the network.

    Args:
        environ: has ``ROS_MASTER_URI``, ``ROS_HOSTNAME`` and ``ROS_IP``; ``os.environ`` by default.
        arguments: ``__master``, ``__hostname`` and ``__ip`` by these keys, which go before it.
        rate: how many seconds of graph time pass in one second.
        seed: what random numbers of this graph start from.
        log_dir: where log files go; by default ``ROS_LOG_DIR``.
        announce: say where it listens. A tool that is over in a moment need not, and says what is wrong all the same.

    Raises ``ROSInitException`` for an address that is none.

    """
    where = addresses(environ, arguments)
    for line in where.notes if announce else where.faults:
        sys.stderr.write(f"rosmini: {line}\n")

    def way(graph: Graph) -> RemoteMaster:
        network = network_of(graph)
        watch = Watch(graph, where.master_uri, network.io, network.client)
        return RemoteMaster(where.master_uri, network.client, watch)

    return Graph(
        simulated=False,
        rate=rate,
        seed=seed,
        strict=False,
        transports=[LocalTransport, tcp(where)],
        log_dir=log_dir,
        master=way,
    )
