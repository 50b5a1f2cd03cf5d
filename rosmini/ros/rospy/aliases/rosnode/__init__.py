"""The module that scripts import as ``rosnode`` (http://wiki.ros.org/rosnode): lists and pings nodes."""

from __future__ import annotations

import sys
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from rosmini.core.errors import MasterUnreachable, RosminiError, TransportException
from rosmini.core.graph import running_graph
from rosmini.ros.introspection import nodes
from rosmini.ros.rospy.aliases import rosgraph
from rosmini.ros.rospy.aliases.rosgraph.names import script_resolve_name
from rosmini.ros.rospy.mains import run_tool

__all__ = [
    "ID",
    "NAME",
    "ROSNodeException",
    "ROSNodeIOException",
    "cleanup_master_blacklist",
    "cleanup_master_whitelist",
    "get_api_uri",
    "get_machines_by_nodes",
    "get_node_connection_info_description",
    "get_node_info_description",
    "get_node_names",
    "get_nodes_by_machine",
    "kill_nodes",
    "rosgraph",
    "rosnode_cleanup",
    "rosnode_info",
    "rosnode_listnodes",
    "rosnode_ping",
    "rosnode_ping_all",
    "rosnodemain",
]

NAME = "rosnode"
ID = nodes.ID


class ROSNodeException(RosminiError):
    """Base class of rosnode's errors."""


class ROSNodeIOException(ROSNodeException):
    """The Master or a node does not answer."""


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


def get_machines_by_nodes() -> list[str]:
    """Return the hosts on which nodes run."""
    with _no_master():
        return nodes.machines(running_graph())


def get_nodes_by_machine(machine: str) -> list[str]:
    """Return the nodes on a host. Raises ``ROSNodeException`` if its name does not resolve."""
    with _no_master():
        found = nodes.nodes_on(running_graph(), machine)
    if found is None:
        raise ROSNodeException(f"cannot resolve machine name [{machine}] to address")
    return found


def kill_nodes(node_names: list[str]) -> tuple[list[str], list[str]]:
    """Ask nodes to shut down; return the nodes that were asked and those unknown to the Master."""
    with _no_master():
        return nodes.kill(running_graph(), node_names)


def rosnode_listnodes(namespace: str | None = None, list_uri: bool = False, list_all: bool = False) -> None:
    """Print the names of the nodes, their addresses, or both."""
    names = get_node_names(namespace)
    if not (list_uri or list_all):
        print("\n".join(names))
        return
    uris = [get_api_uri(None, name) or "unknown address" for name in names]
    print("\n".join(f"{uri} \t{name}" if list_all else uri for uri, name in zip(uris, names, strict=True)))


def rosnode_ping(node_name: str, max_count: int | None = None, verbose: bool = False, skip_cache: bool = False) -> bool:
    """Ping a node ``max_count`` times, once a second (None: until Ctrl-C); return True if it answers."""
    uri = get_api_uri(None, node_name, skip_cache)
    if uri is None:
        print(f"cannot ping [{node_name}]: unknown node", file=sys.stderr)
        return False
    say: Callable[[str], object] = print if verbose else lambda _: None
    say(f"pinging {node_name} with a timeout of 3.0s")
    graph = running_graph()
    times: list[float] = []
    try:
        while True:
            times.append(nodes.ping(graph, uri))
            say(f"xmlrpc reply from {uri}\ttime={times[-1]:f}ms")
            if max_count and len(times) >= max_count:
                break
            graph.scheduler.sleep_until(graph.scheduler.now_ns() + 1_000_000_000)
    except TransportException as error:
        print(nodes.why_silent(error, node_name, uri), file=sys.stderr)
        return False
    except KeyboardInterrupt:
        pass
    if len(times) > 1:
        say(f"ping average: {sum(times) / len(times):f}ms")
    return True


def rosnode_ping_all(verbose: bool = False, skip_cache: bool = False) -> tuple[list[str], list[str]]:
    """Ping all nodes once; return those that answered and those that did not."""
    names = get_node_names()
    if verbose:
        print("Will ping the following nodes: \n" + "".join(f" * {name}\n" for name in names))
    answered = {name: rosnode_ping(name, 1, verbose, skip_cache) for name in names}
    return [name for name in names if answered[name]], [name for name in names if not answered[name]]


def cleanup_master_blacklist(master: Any, blacklist: Collection[str]) -> None:  # noqa: ARG001 - as in ROS
    """Unregister some nodes at the Master."""
    for name in blacklist:
        print("Unregistering", name)
        with _no_master():
            nodes.forget(running_graph(), [name])


def cleanup_master_whitelist(master: Any, whitelist: Collection[str]) -> None:  # noqa: ARG001 - as in ROS
    """Unregister all but some nodes at the Master."""
    with _no_master():
        nodes.forget(running_graph(), [name for name in get_node_names() if name not in whitelist])


def rosnode_cleanup() -> None:
    """Ask on standard input whether to unregister the nodes that do not answer, and do so."""
    _, silent = rosnode_ping_all()
    if not silent:
        return
    print("Unable to contact the following nodes:")
    print("\n".join(f" * {name}" for name in silent))
    print("Warning: these might include alive and functioning nodes, e.g. in unstable networks.")
    print("Cleanup will purge all information about these nodes from the master.")
    print("Please type y or n to continue:")
    typed = sys.stdin.readline()
    while typed and typed.strip() not in ("y", "n"):
        typed = sys.stdin.readline()
    if typed.strip() != "y":
        print("aborting")
        return
    cleanup_master_blacklist(None, silent)
    print("done")


def get_node_info_description(node_name: str) -> str:
    """Return the Master's information on a node, as ``rosnode info`` prints it."""
    with _no_master():
        return str(nodes.describe(running_graph(), node_name))


def get_node_connection_info_description(node_api: str, master: Any) -> str:  # noqa: ARG001 - as in ROS
    """Return a node's own information, as ``rosnode info`` prints it. Raises ``ROSNodeIOException``."""
    try:
        with _no_master():
            return str(nodes.contact(running_graph(), node_api))
    except TransportException as error:
        raise ROSNodeIOException(f"Communication with node[{node_api}] failed!") from error


def rosnode_info(node_name: str, quiet: bool = False) -> None:
    """Print the information on a node."""
    name = script_resolve_name(NAME, node_name)
    print("-" * 80)
    print(get_node_info_description(name))
    uri = get_api_uri(None, name)
    if uri is None:
        print(f"cannot contact [{name}]: unknown node", file=sys.stderr)
    elif not quiet:
        print(f"\ncontacting node {uri} ...")
        print(get_node_connection_info_description(uri, None))


def rosnodemain(argv: Sequence[str] | None = None) -> None:
    """Run a rosnode command line, ``sys.argv`` if None; raise ``SystemExit`` if it fails."""
    run_tool("rosnode", argv)
