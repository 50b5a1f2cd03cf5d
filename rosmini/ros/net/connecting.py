"""Connects a graph of this process with a Master, for nodes and tools in a terminal."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from rosmini.core.graph import Graph
from rosmini.core.graph.local_transport import LocalTransport

from .addresses import addresses
from .network import network_of, tcp
from .remote_master import RemoteMaster
from .watch import Watch


def connect(
    environ: Mapping[str, str] | None = None,
    arguments: Mapping[str, str] | None = None,
    *,
    rate: float = 1.0,
    seed: int = 0,
    log_dir: str | Path | None = None,
    announce: bool = True,
) -> Graph:
    """Return a graph in wall-clock time whose nodes belong to the graph of the Master that the environment names.

    The Master is not contacted yet; it may start later. Nodes of this process exchange messages directly, all others
    over TCPROS. A process that listens on the network, or whose addresses are wrong, says so on standard error.
    ``shutdown`` of the graph (or leaving its ``with`` block) closes its network connections.

    Args:
        environ: has ``ROS_MASTER_URI``, ``ROS_HOSTNAME`` and ``ROS_IP``; ``os.environ`` by default.
        arguments: ``__master``, ``__hostname`` and ``__ip`` by these keys, which take precedence.
        rate: seconds of graph time per second.
        seed: seed of this graph's random numbers.
        log_dir: folder for log files; by default ``ROS_LOG_DIR``.
        announce: print where it listens. A short-lived tool can omit this; faults are printed in any case.

    Raises ``ROSInitException`` for an invalid address.

    """
    where = addresses(environ, arguments)
    for line in where.notes if announce else where.faults:
        sys.stderr.write(f"rosmini: {line}\n")

    def remote_master(graph: Graph) -> RemoteMaster:
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
        master=remote_master,
    )
