"""Functions of ``rostopic``: list topics and their types, and resolve a name followed by fields."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from rosmini.core.errors import TransportException
from rosmini.core.peers import Peers

from .nodes import Flow, flows, namespace_of

ID = "/rostopic"
"""Caller name for calls to the Master."""

UNKNOWN = "unknown type"
ANY_TYPE = "*"


class Topic(NamedTuple):
    """One side of a topic: its name, its type, and its publishers or its subscribers."""

    name: str
    type: str
    nodes: tuple[str, ...]


class Topics(NamedTuple):
    """Published topics, and topics with subscribers."""

    published: tuple[Topic, ...]
    subscribed: tuple[Topic, ...]

    def within(self, name: str) -> Topics:
        """Return the topic of a name and those in the namespace of that name."""
        start = namespace_of(name)
        sides = ([each for each in side if each.name == name or each.name.startswith(start)] for side in self)
        return Topics(*map(tuple, sides))

    def names(self) -> list[str]:
        """Return all names, sorted."""
        return sorted({each.name for side in self for each in side})


def types(peers: Peers) -> list[tuple[str, str]]:
    """Return the topics with a known type, and their types, in the Master's order."""
    return [(name, kind) for name, kind in peers.ask_as(ID).ask("getTopicTypes")]


def topics(peers: Peers) -> Topics:
    """Return all topics."""
    state = peers.ask_as(ID).ask("getSystemState")
    known = dict(types(peers))
    sides = ([Topic(name, known.get(name, UNKNOWN), tuple(held)) for name, held in side] for side in state[:2])
    return Topics(*map(tuple, sides))


def by_type(peers: Peers, kind: str) -> list[str]:
    """Return the topics of a type."""
    return [name for name, one in types(peers) if one == kind]


class Found(NamedTuple):
    """The topic that a name refers to, its type, and the rest of the name: ``/pose/position/x`` or empty."""

    topic: str
    type: str
    path: str


def look_up(peers: Peers, name: str) -> Found | None:
    """Return the topic of a name, which may continue with fields of its messages; None if not found."""
    known = types(peers)
    for topic, kind in known:
        if topic == name:
            return None if kind == ANY_TYPE else Found(topic, kind, "")
    longest_first = sorted(((t, k) for t, k in known if name.startswith(f"{t}/")), reverse=True)
    for topic, kind in longest_first:
        path = name[len(topic) :]
        if kind != ANY_TYPE and _may_have(kind, path):
            return Found(topic, kind, path)
    return None


def _may_have(kind: str, path: str) -> bool:
    """Return True if messages of a type may have a field; checked up to the first array."""
    from .fields import class_of, field_type

    if class_of(kind) is None:
        return True  # the unknown type is reported later
    return field_type(kind, path.rstrip("/").partition("[")[0]) is not None


def what_next(peers: Peers, name: str) -> str:
    """Return a hint about an unknown topic: similar names, or the field that the topic lacks."""
    from rosmini.core.errors import nearest

    for topic, kind in sorted(types(peers), reverse=True):
        if name.startswith(f"{topic}/"):
            from .fields import class_of

            known = getattr(class_of(kind), "__slots__", ())
            wanted = name[len(topic) + 1 :].partition("/")[0].partition("[")[0]
            hint = nearest(wanted, known) or f"its fields are {', '.join(known)}"
            return f"messages on {topic} are {kind} and have no {name[len(topic) + 1 :]}; {hint}"
    names, wanted = topics(peers).names(), name
    while wanted:  # the last parts may be fields
        hint = nearest(wanted, names)
        if hint:
            return hint
        wanted = wanted.rpartition("/")[0]
    return "`rostopic list` lists the topics that there are."


def addresses(peers: Peers, nodes: Iterable[str]) -> dict[str, str]:
    """Return the addresses of nodes; for a node unknown to the Master, a text that says so."""
    master = peers.ask_as(ID)
    return {node: master.find("lookupNode", node) or f"unknown address {node}" for node in nodes}


class About(NamedTuple):
    """A topic's type, its publishers and its subscribers: names with addresses."""

    type: str
    publishers: dict[str, str]
    subscribers: dict[str, str]
    flows: tuple[Flow, ...] | None = None
    """Connections with their numbers of dropped messages, if requested."""

    def __str__(self) -> str:
        text = f"Type: {self.type}\n\n"
        for title, nodes in (("Publishers", self.publishers), ("Subscribers", self.subscribers)):
            listed = "".join(f" * {node} ({uri})\n" for node, uri in nodes.items())
            text += f"{title}: \n{listed}\n" if nodes else f"{title}: None\n\n"
        if self.flows is not None:
            drops = "".join(f" * {flow}\n" for flow in self.flows if flow.dropped)
            text += f"Dropped messages: \n{drops}\n" if drops else "Dropped messages: None\n\n"
        return text


def about(peers: Peers, name: str, *, count_drops: bool = False) -> About | None:
    """Return the nodes on a topic; None if there are none. ``count_drops``: also ask them for dropped messages."""
    found = topics(peers)
    sides = [[each for each in side if each.name == name] for side in found]
    if not any(sides):
        return None
    ends = [addresses(peers, [node for each in side for node in each.nodes]) for side in sides]
    dropped = _flows(peers, name, ends[0] | ends[1]) if count_drops else None
    return About(next(each.type for side in sides for each in side), ends[0], ends[1], dropped)


def _flows(peers: Peers, topic: str, uris: dict[str, str]) -> tuple[Flow, ...]:
    """Return the connections on a topic; nodes that do not answer are omitted."""
    names = {uri: node for node, uri in uris.items()}
    found: list[Flow] = []
    for node, uri in sorted(uris.items()):
        try:
            found += [each for each in flows(peers, ID, node, uri, names) if each.topic == topic]
        except TransportException:
            continue
    return tuple(found)
