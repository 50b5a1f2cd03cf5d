"""What ``rosservice`` finds out: which services there are, who offers them, where, and of which types.

The Master knows a service's name, node and address; its type only its server tells, to a connection that asks for
nothing else (http://wiki.ros.org/ROS/TCPROS).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from rosmini.core.errors import TransportException, nearest

from .nodes import namespace_of

if TYPE_CHECKING:
    from rosmini.core.peers import Peers

ID = "/rosservice"
"""In whose name the Master and the servers are asked."""


class Service(NamedTuple):
    """A service and the nodes that offer it: as a rule one."""

    name: str
    nodes: tuple[str, ...]


def services(peers: Peers, namespace: str | None = None) -> list[Service]:
    """Return all services as the Master lists them; with a namespace, those in it or of this name."""
    found = [Service(name, tuple(nodes)) for name, nodes in peers.ask_as(ID).ask("getSystemState")[2]]
    if not namespace:
        return found
    within = namespace_of(namespace)
    return [each for each in found if each.name == namespace or each.name.startswith(within)]


def node_of(peers: Peers, name: str) -> str | None:
    """Return the node that offers a service, or None."""
    return next((each.nodes[0] for each in services(peers) if each.name == name and each.nodes), None)


def uri_of(peers: Peers, name: str) -> str | None:
    """Return the address of a service, ``rosrpc://host:port``, or None if nobody offers it."""
    found: str | None = peers.ask_as(ID).find("lookupService", name)
    return found


def type_of(peers: Peers, name: str) -> str | None:
    """Return the type of a service; None if nobody offers it, or its server does not say.

    Raises ``TransportException`` if the server does not answer.
    """
    uri = uri_of(peers, name)
    if uri is None:
        return None
    return headers(peers, name, uri).get("type")


def headers(peers: Peers, name: str, uri: str) -> dict[str, str]:
    """Return what the server of a service says of itself. Raises ``TransportException`` if it does not answer."""
    return peers.transport.probe_service(uri, {"probe": "1", "md5sum": "*", "callerid": ID, "service": name})


def by_type(peers: Peers, kind: str) -> list[str]:
    """Return the services of a type; those whose servers do not answer are left out."""
    found: list[str] = []
    for service in services(peers):
        try:
            if type_of(peers, service.name) == kind:
                found.append(service.name)
        except TransportException:
            continue
    return found


def what_next(peers: Peers, name: str) -> str:
    """Return a sentence for a name of no service: what resembles it, or how to see which there are."""
    known = [service.name for service in services(peers)]
    return nearest(name, known) or "`rosservice list` lists the services that there are."
