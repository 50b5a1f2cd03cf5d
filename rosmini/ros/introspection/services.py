"""Functions of ``rosservice``: list services, and find their nodes, addresses and types.

The Master knows a service's name, node and address; only its server knows the type, and reports it to a probe
connection (http://wiki.ros.org/ROS/TCPROS).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.errors import TransportException, nearest

from .nodes import namespace_of

if TYPE_CHECKING:
    from rosmini.core.peers import Peers

ID = "/rosservice"
"""Caller name for calls to the Master and the servers."""


class Service(NamedTuple):
    """A service and the nodes that offer it, normally one."""

    name: str
    nodes: tuple[str, ...]


def services(peers: Peers, namespace: str | None = None) -> list[Service]:
    """Return all services in the Master's order; with a namespace, those in it or with this name."""
    found = [Service(name, tuple(nodes)) for name, nodes in peers.ask_as(ID).ask("getSystemState")[2]]
    if not namespace:
        return found
    within = namespace_of(namespace)
    return [each for each in found if each.name == namespace or each.name.startswith(within)]


def node_of(peers: Peers, name: str) -> str | None:
    """Return the node that offers a service, or None."""
    return next((each.nodes[0] for each in services(peers) if each.name == name and each.nodes), None)


def uri_of(peers: Peers, name: str) -> str | None:
    """Return the address of a service, ``rosrpc://host:port``, or None if no node offers it."""
    found: str | None = peers.ask_as(ID).find("lookupService", name)
    return found


def type_of(peers: Peers, name: str) -> str | None:
    """Return the type of a service; None if no node offers it, or its server does not report it.

    Raises ``TransportException`` if the server does not answer.
    """
    uri = uri_of(peers, name)
    if uri is None:
        return None
    return headers(peers, name, uri).get("type")


def headers(peers: Peers, name: str, uri: str) -> dict[str, str]:
    """Return the header that a service's server sends. Raises ``TransportException`` if it does not answer."""
    return peers.transport.probe_service(uri, {"probe": "1", "md5sum": "*", "callerid": ID, "service": name})


def by_type(peers: Peers, kind: str) -> list[str]:
    """Return the services of a type; those whose servers do not answer are omitted."""
    found: list[str] = []
    for service in services(peers):
        try:
            if type_of(peers, service.name) == kind:
                found.append(service.name)
        except TransportException:
            continue
    return found


def what_next(peers: Peers, name: str) -> str:
    """Return a hint about an unknown service: similar names, or how to list the services."""
    known = [service.name for service in services(peers)]
    return nearest(name, known) or "`rosservice list` lists the services that there are."
