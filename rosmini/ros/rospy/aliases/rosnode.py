"""The module that scripts import as ``rosnode`` (http://wiki.ros.org/rosnode): lists, pings and ends nodes."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import MasterUnreachable, RosminiError, TransportException
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import nodes
from rosmini.ros.rospy.aliases import rosgraph

__all__ = [
    "ID",
    "ROSNodeException",
    "ROSNodeIOException",
    "get_api_uri",
    "get_node_names",
    "kill_nodes",
    "rosgraph",
    "rosnode_ping",
]

ID = nodes.ID


class ROSNodeException(RosminiError):
    """Base class of rosnode's errors."""


class ROSNodeIOException(ROSNodeException):
    """The Master does not answer."""


@contextmanager
def _no_master() -> Iterator[None]:
    try:
        yield
    except MasterUnreachable as error:
        raise ROSNodeIOException(f"Unable to communicate with master! {error}") from error


def get_api_uri(master: Any, caller_id: str, skip_cache: bool = False) -> str | None:  # noqa: ARG001 - as in ROS
    """Return the address of a node's slave API, or None if the Master does not know it."""
    with _no_master():
        return nodes.uri_of(running_graph(), caller_id)


def get_node_names(namespace: str | None = None) -> list[str]:
    """Return the names of all nodes, or of those in a namespace. Raises ``ROSNodeIOException``."""
    with _no_master():
        return nodes.names(running_graph(), namespace)


def kill_nodes(node_names: list[str]) -> tuple[list[str], list[str]]:
    """Ask nodes to shut down; return the nodes that were asked and those unknown to the Master."""
    with _no_master():
        return nodes.kill(running_graph(), node_names)


def rosnode_ping(node_name: str, max_count: int | None = None, verbose: bool = False, skip_cache: bool = False) -> bool:
    """Ping a node ``max_count`` times, once a second (None: until Ctrl-C); return True if it answers."""
    uri = get_api_uri(None, node_name, skip_cache)
    if uri is None:
        print(f"cannot ping [{node_name}]: unknown node", file=sys.stderr)
        return False
    if verbose:
        print(f"pinging {node_name} with a timeout of 3.0s")
    graph, count = running_graph(), 0
    try:
        while True:
            took_ms, count = nodes.ping(graph, uri), count + 1
            if verbose:
                print(f"xmlrpc reply from {uri}\ttime={took_ms:f}ms")
            if max_count and count >= max_count:
                return True
            graph.scheduler.sleep_until(graph.scheduler.now_ns() + 1_000_000_000)
    except TransportException as error:
        print(nodes.why_silent(error, node_name, uri), file=sys.stderr)
        return False
    except KeyboardInterrupt:
        return True
