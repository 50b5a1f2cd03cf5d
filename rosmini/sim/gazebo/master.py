"""At which address Gazebo's Master is, and which server started it.

GAZEBO_MASTER_URI names the address, http://localhost:11345 if it is not set. Server and client of one graph find each other by it; on one address
there is one server.
"""

from __future__ import annotations

import os
import weakref
from typing import TYPE_CHECKING

from rosmini.graph import Graph

from .errors import GazeboError
from .transport import Master

if TYPE_CHECKING:
    from .server import GazeboServer

VARIABLE = "GAZEBO_MASTER_URI"
DEFAULT = "http://localhost:11345"

_RUNNING: weakref.WeakKeyDictionary[Graph, dict[str, RunningMaster]] = weakref.WeakKeyDictionary()


def address() -> str:
    """Where the Master is looked for."""
    return os.environ.get(VARIABLE) or DEFAULT


class RunningMaster(Master):
    """A Master that a server started."""

    def __init__(self, graph: Graph, uri: str, server: GazeboServer, namespace: str) -> None:
        super().__init__()
        self.uri = uri
        self.server = server
        self.namespace = namespace
        """What `~` stands for in the names of topics, after /gazebo/: the name of the world."""
        self._graph = weakref.ref(graph)

    def close(self) -> None:
        """End: the address is free again."""
        graph = self._graph()
        if graph is not None:
            _RUNNING.get(graph, {}).pop(self.uri, None)


def start_master(graph: Graph, server: GazeboServer, namespace: str) -> RunningMaster:
    """Start the Master of a server. Raises `GazeboError` if there is one at the address."""
    uri = address()
    there = _RUNNING.setdefault(graph, {})
    if uri in there:
        msg = (
            f"Unable to start server[bind: Address already in use]: {there[uri].server.node.name} runs at {uri}. One server is enough for many robots; "
            f"for a second world set {VARIABLE} to another address"
        )
        raise GazeboError(msg)
    there[uri] = RunningMaster(graph, uri, server, namespace)
    return there[uri]


def find_master(graph: Graph) -> RunningMaster | None:
    """The Master at the address, if a server of the graph runs there."""
    return _RUNNING.get(graph, {}).get(address())
