"""Functions of ``rosnode``: list, describe, ping and shut down nodes.

The Master knows nodes by their registrations (http://wiki.ros.org/ROS/Master_API); only a node itself can
show that it is alive (http://wiki.ros.org/ROS/Slave_API).
"""

from __future__ import annotations

import re
import socket
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from rosmini.core.errors import ROSException, TransportException
from rosmini.core.peers import Asker, Peers, host_of

ID = "/rosnode"
"""Caller name for calls to the Master and the nodes."""

_PORTS = re.compile(r"\w+ connection on port (\d+) to \[(.*) on socket (\d+)\]")
"""Format in which clients describe a TCP connection."""


def namespace_of(name: str) -> str:
    """Return a global name as a namespace prefix: with slashes at both ends."""
    return f"/{name.strip('/')}/" if name.strip("/") else "/"


def names(peers: Peers, namespace: str | None = None) -> list[str]:
    """Return the names of all nodes, sorted; with a namespace, those in it or with this name."""
    state = peers.ask_as(ID).ask("getSystemState")
    found = {name for part in state for _, holders in part for name in holders}
    if namespace:
        within = namespace_of(namespace)
        found = {name for name in found if name == namespace or name.startswith(within)}
    return sorted(found)


def uri_of(peers: Peers, name: str) -> str | None:
    """Return the address of a node's slave API, or None if the Master does not know the node."""
    found: str | None = peers.ask_as(ID).find("lookupNode", name)
    return found


# -- one node --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Description:
    """Registrations of a node at the Master: topics with their types, and services, sorted."""

    name: str
    publications: tuple[tuple[str, str], ...]
    subscriptions: tuple[tuple[str, str], ...]
    services: tuple[str, ...]

    def __str__(self) -> str:
        def topics(pairs: Iterable[tuple[str, str]]) -> list[str]:
            return [f"{topic} [{kind}]" for topic, kind in pairs]

        parts = [("Publications", topics(self.publications)), ("Subscriptions", topics(self.subscriptions))]
        text = f"Node [{self.name}]"
        for title, lines in [*parts, ("Services", list(self.services))]:
            listed = "".join(f" * {line}\n" for line in lines)
            text += f"\n{title}: \n{listed}" if lines else f"\n{title}: None\n"
        return text


def describe(peers: Peers, name: str) -> Description:
    """Return the registrations of a node; empty for an unknown node."""
    master = peers.ask_as(ID)
    state = master.ask("getSystemState")
    kinds = dict(master.ask("getPublishedTopics", "/"))
    published, subscribed, services = (sorted(item for item, holders in part if name in holders) for part in state)

    def typed(topics: list[str]) -> tuple[tuple[str, str], ...]:
        return tuple((topic, kinds.get(topic, "unknown type")) for topic in topics)

    return Description(name, typed(published), typed(subscribed), tuple(services))


@dataclass(frozen=True)
class Link:
    """A connection of a node: topic, peer, ``inbound`` or ``outbound``, transport, and its TCP ports."""

    topic: str
    to: str
    direction: str
    transport: str
    ports: str = ""

    def __str__(self) -> str:
        return (
            f" * topic: {self.topic}\n    * to: {self.to}\n"
            f"    * direction: {self.direction}{self.ports}\n    * transport: {self.transport}\n"
        )


@dataclass(frozen=True)
class Contact:
    """A node's own information: its process id and its connections."""

    pid: int
    links: tuple[Link, ...]
    has_connections: bool

    def __str__(self) -> str:
        listed = "".join(map(str, self.links))
        return f"Pid: {self.pid}\n" + (f"Connections:\n{listed}" if self.has_connections else "")


def contact(peers: Peers, uri: str) -> Contact:
    """Ask a node for its process id and connections. Raises ``TransportException`` if it does not answer."""
    master = peers.ask_as(ID)
    state = master.ask("getSystemState")
    pid = succeed(peers.transport.call(uri, "getPid", ID))
    rows = succeed(peers.transport.call(uri, "getBusInfo", ID))
    addresses: dict[str, str | None] = {}
    links = tuple(
        _link(row, _name_at(master, state, row[4], row[1], addresses))
        for row in rows
        if len(row) <= 5 or row[5]  # older clients do not report whether it is connected
    )
    return Contact(pid, links, bool(rows))


def succeed(answer: Sequence[Any]) -> Any:
    """Return the value of an answer. Raises ``ROSException`` for any code but 1."""
    code, status, value = answer
    if code != 1:
        raise ROSException(f"remote call failed: {status}")
    return value


def _link(row: Sequence[Any], to: str) -> Link:
    direction = {"i": "inbound", "o": "outbound"}.get(row[2], "unknown")
    found = _PORTS.match(row[6]) if len(row) > 6 else None
    ports = "" if found is None else " ({} - {}) [{}]".format(*found.groups())
    return Link(row[4], to, direction, row[3], ports)


def _name_at(master: Asker, state: Any, topic: str, uri: str, addresses: dict[str, str | None]) -> str:
    """Return name and address of the node with an address on a topic; the given address if no node matches."""
    for part in state[:2]:
        for name in next((holders for item, holders in part if item == topic), ()):
            if name not in addresses:
                addresses[name] = master.find("lookupNode", name)
            if addresses[name] == uri:
                return f"{name} ({uri})"
    return uri


class Flow(NamedTuple):
    """One end of a topic connection, with the number of messages dropped by its queue, as counted by its node."""

    topic: str
    publisher: str
    subscriber: str
    side: str
    """Owner of the queue: "publisher" or "subscriber"."""
    dropped: int

    def __str__(self) -> str:
        return (
            f"{self.publisher} -> {self.subscriber} ({self.topic}): {self.dropped} dropped by the queue of the "
            f"{self.side}"
        )


def flows(peers: Peers, caller: str, name: str, uri: str, names: Mapping[str, str]) -> tuple[Flow, ...]:
    """Ask a node for its dropped messages; empty for clients that do not count them or use another format.

    ``names`` maps addresses to names of nodes. Raises ``TransportException`` if the node does not answer.
    """
    stats, rows = (peers.transport.call(uri, method, caller) for method in ("getBusStats", "getBusInfo"))
    try:
        return tuple(_flows(stats, rows, name, names))
    except (LookupError, TypeError, ValueError):
        return ()


def _flows(stats: Any, rows: Any, name: str, names: Mapping[str, str]) -> Iterator[Flow]:
    published, subscribed, *_ = stats[2] if stats[0] == 1 else stats  # roscpp's answer has no code
    others = {row[0]: names.get(row[1], str(row[1])) for row in rows[2]}
    for topic, _, links in published:
        for row in links:
            if len(row) > 4 and row[0] in others:  # rosmini's addition
                yield Flow(topic, name, others[row[0]], "publisher", int(row[4]))
    for topic, links in subscribed:
        for row in links:
            dropped = int(row[3] if len(row) > 4 else row[2])  # rospy and roscpp count the messages before it
            if dropped >= 0 and row[0] in others:
                yield Flow(topic, others[row[0]], name, "subscriber", dropped)


def ping(peers: Peers, uri: str) -> float:
    """Return how long a node took to answer [ms]. Raises ``TransportException`` if it does not."""
    clock = peers.scheduler
    start = clock.now_ns()
    succeed(peers.transport.call(uri, "getPid", ID))
    return (clock.now_ns() - start) / 1e6


def why_silent(error: TransportException, name: str, uri: str) -> str:
    """Return the message of ``rosnode ping`` about a node that did not answer."""
    cause = error.__cause__
    if isinstance(cause, TimeoutError):
        return f"connection to [{name}] timed out"
    if isinstance(cause, socket.gaierror):
        return f"ERROR: Unknown host [{host_of(uri)}] for node [{name}]"
    if cause is None or isinstance(cause, ConnectionRefusedError):
        return f"ERROR: connection refused to [{uri}]"
    return f"connection to [{name}] failed"


# -- machines --------------------------------------------------------------------------------------------------------


def machines(peers: Peers) -> list[str]:
    """Return the hosts in the addresses of all nodes, sorted."""
    return sorted({host for _, host in _hosts(peers)})


def nodes_on(peers: Peers, machine: str) -> list[str] | None:
    """Return the nodes on a machine, sorted; None if the machine's name does not resolve and it has no nodes."""
    hosts = _hosts(peers)
    here = _resolved(machine)
    if not here and machine not in {host for _, host in hosts}:
        return None
    matches = {host: host == machine or bool(here & _resolved(host)) for _, host in set(hosts)}
    return [name for name, host in hosts if matches[host]]


def _hosts(peers: Peers) -> list[tuple[str, str]]:
    found = ((name, uri_of(peers, name)) for name in names(peers))
    return [(name, host_of(uri)) for name, uri in found if uri is not None]


def _resolved(host: str) -> set[str]:
    try:
        return {str(info[4][0]) for info in socket.getaddrinfo(host, 0, 0, 0, socket.SOL_TCP)}
    except (OSError, UnicodeError):
        return set()


# -- ending nodes ----------------------------------------------------------------------------------------------------


def kill(peers: Peers, wanted: Iterable[str]) -> tuple[list[str], list[str]]:
    """Ask nodes to shut down; return the nodes that were asked and those unknown to the Master.

    A node may end before it has answered, so a missing answer is not a failure.
    """
    asked: list[str] = []
    unknown: list[str] = []
    for name in wanted:
        uri = uri_of(peers, name)
        (unknown if uri is None else asked).append(name)
        if uri is None:
            continue
        try:
            peers.transport.call(uri, "shutdown", ID, "user request")
        except TransportException:
            continue
    return asked, unknown


def silent(peers: Peers, among: Iterable[str]) -> dict[str, str]:
    """Return the nodes that do not answer, each with the message of ``rosnode ping``."""
    found: dict[str, str] = {}
    for name in among:
        uri = uri_of(peers, name)
        if uri is None:
            found[name] = f"cannot ping [{name}]: unknown node"
            continue
        try:
            ping(peers, uri)
        except TransportException as error:
            found[name] = why_silent(error, name, uri)
    return found


def forget(peers: Peers, gone: Iterable[str]) -> None:
    """Unregister everything of dead nodes in their name, as they would have done themselves."""
    published, subscribed, services = peers.ask_as(ID).ask("getSystemState")
    for name in gone:
        master = peers.ask_as(name)
        uri = uri_of(peers, name) or ""
        for topic in _held(published, name):
            master.call("unregisterPublisher", topic, uri)
        for topic in _held(subscribed, name):
            master.call("unregisterSubscriber", topic, uri)
        for service in _held(services, name):
            master.call("unregisterService", service, master.find("lookupService", service) or "")


def _held(part: Any, name: str) -> list[str]:
    return [item for item, holders in part if name in holders]
