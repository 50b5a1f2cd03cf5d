"""The information collected from the Master and the nodes before the rules are applied."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from rosmini.core.errors import ROSException, TransportException
from rosmini.ros.introspection.nodes import Flow, flows, succeed, why_silent

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rosmini.core.peers import Peers

ID = "/roswtf"
"""Caller name for calls to the Master and the nodes."""


@dataclass(frozen=True)
class Node:
    """A node's own information; ``silence`` is the message of ``rosnode ping`` if it does not answer."""

    name: str
    uri: str
    published: Mapping[str, str] = field(default_factory=dict)
    """Its topics with their types."""
    subscribed: Mapping[str, str] = field(default_factory=dict)
    sources: frozenset[tuple[str, str]] = frozenset()
    """(topic, address or name of the publisher) of each open inbound connection."""
    flows: tuple[Flow, ...] = ()
    """Its connections, with their numbers of dropped messages."""
    silence: str = ""


@dataclass(frozen=True)
class Survey:
    """A graph at one moment: nodes by name, the nodes on each topic and service, and all parameters."""

    nodes: Mapping[str, Node]
    publishers: Mapping[str, tuple[str, ...]]
    subscribers: Mapping[str, tuple[str, ...]]
    services: Mapping[str, tuple[str, ...]]
    parameters: Mapping[str, Any]

    def types(self, topic: str) -> dict[str, list[str]]:
        """Return the types of a topic according to its nodes: types, sorted, with the nodes; ``*`` agrees with all."""
        found: dict[str, list[str]] = {}
        for name in sorted({*self.publishers.get(topic, ()), *self.subscribers.get(topic, ())}):
            node = self.nodes[name]
            for kind in sorted({side[topic] for side in (node.published, node.subscribed) if topic in side}):
                if kind != "*":
                    found.setdefault(kind, []).append(name)
        return dict(sorted(found.items()))

    def parameter(self, *path: str) -> Any:
        """Return a parameter, or None if it is not set."""
        value: Any = self.parameters
        for part in path:
            value = value.get(part) if isinstance(value, dict) else None
        return value


def survey(peers: Peers) -> Survey:
    """Query the Master and every node that it knows. Raises ``MasterUnreachable``."""
    master = peers.ask_as(ID)
    published, subscribed, services = (
        {name: tuple(sorted(holders)) for name, holders in part} for part in master.ask("getSystemState")
    )
    names = sorted({name for part in (published, subscribed, services) for held in part.values() for name in held})
    parameters = master.find("getParam", "/")
    uris = {name: master.find("lookupNode", name) for name in names}
    by_uri = {uri: name for name, uri in uris.items() if uri is not None}
    return Survey(
        {name: _node(peers, name, uri, by_uri) for name, uri in uris.items()},
        published,
        subscribed,
        services,
        parameters if isinstance(parameters, dict) else {},
    )


def _node(peers: Peers, name: str, uri: str | None, names: Mapping[str, str]) -> Node:
    if uri is None:
        return Node(name, "", silence=f"the Master lists [{name}] and has no address of it")
    try:
        published, subscribed, links = (
            succeed(peers.transport.call(uri, method, ID))
            for method in ("getPublications", "getSubscriptions", "getBusInfo")
        )
        return Node(
            name,
            uri,
            dict(published),
            dict(subscribed),
            frozenset(map(_source, filter(_is_source, links))),
            flows(peers, ID, name, uri, names),
        )
    except TransportException as error:
        return Node(name, uri, silence=why_silent(error, name, uri))
    except (ROSException, ValueError, TypeError, IndexError) as error:
        return Node(name, uri, silence=f"[{name}] answers what no ROS node does: {str(error)[:80]}")


def _is_source(row: list[Any]) -> bool:
    return row[2] == "i" and (len(row) <= 5 or bool(row[5]))  # older clients do not report whether it is connected


def _source(row: list[Any]) -> tuple[str, str]:
    return str(row[4]), str(row[1])
