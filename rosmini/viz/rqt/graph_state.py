"""The state of a computation graph that rqt_graph draws: publishers and subscribers, as a plain value."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from rosmini.viz.view import ViewError

Connection = tuple[str, str, str]
"""(publisher, topic, subscriber)"""

CALLER_ID = "/rqt_graph"


@dataclass(frozen=True)
class GraphState:
    """One moment of a computation graph.

    Attributes:
        publishers: the publishing nodes of each topic.
        subscribers: the subscribing nodes of each topic.
        types: the message type of each topic, where the Master knows one.
        nodes: nodes that may be on no topic (the Master knows them by their services).
        unreachable: nodes that are registered but do not answer.

    """

    publishers: Mapping[str, frozenset[str]] = field(default_factory=dict)
    subscribers: Mapping[str, frozenset[str]] = field(default_factory=dict)
    types: Mapping[str, str] = field(default_factory=dict)
    nodes: frozenset[str] = frozenset()
    unreachable: frozenset[str] = frozenset()

    @property
    def topics(self) -> list[str]:
        """All topics with a publisher or a subscriber, sorted."""
        return sorted({t for side in (self.publishers, self.subscribers) for t, nodes in side.items() if nodes})

    @property
    def all_nodes(self) -> list[str]:
        """All nodes, sorted."""
        found = set(self.nodes) | set(self.unreachable)
        for side in (self.publishers, self.subscribers):
            for nodes in side.values():
                found |= nodes
        return sorted(found)

    def edges(self) -> list[Connection]:
        """Every (publisher, topic, subscriber), sorted: the Master connects all of them."""
        return [
            (publisher, topic, subscriber)
            for topic in self.topics
            for publisher in sorted(self.publishers.get(topic, ()))
            for subscriber in sorted(self.subscribers.get(topic, ()))
        ]

    def joined(self, other: GraphState) -> GraphState:
        """Return the union of two states."""

        def both(mine: Mapping[str, frozenset[str]], theirs: Mapping[str, frozenset[str]]) -> dict[str, frozenset[str]]:
            return {
                topic: mine.get(topic, frozenset()) | theirs.get(topic, frozenset())
                for topic in sorted({*mine, *theirs})
            }

        return GraphState(
            publishers=both(self.publishers, other.publishers),
            subscribers=both(self.subscribers, other.subscribers),
            types={**self.types, **other.types},
            nodes=self.nodes | other.nodes,
            unreachable=other.unreachable,
        )

    def parts(self) -> frozenset[str]:
        """Return the names of all nodes, topics and arrows, in the form of a drawing."""
        ends = {f"p:{node} {topic}" for topic, nodes in self.publishers.items() for node in nodes}
        ends |= {f"s:{topic} {node}" for topic, nodes in self.subscribers.items() for node in nodes}
        named = {f"n:{node}" for node in self.all_nodes} | {f"t:{topic}" for topic in self.topics}
        return frozenset(ends | named | {" ".join(edge) for edge in self.edges()})

    @classmethod
    def of(
        cls,
        system_state: Sequence[Iterable[Sequence[Any]]],
        types: Iterable[Sequence[str]] = (),
        *,
        unreachable: Iterable[str] = (),
    ) -> GraphState:
        """Create a state from the Master's `getSystemState` and `getTopicTypes` (ROS Master API).

        Args:
            system_state: `[publishers, subscribers, services]`, each a list of `[name, [node, ...]]`.
            types: a list of `[topic, type]`.
            unreachable: names of nodes that do not answer.

        Raises:
            ViewError: `system_state` has another form.

        """
        try:
            publishers, subscribers, services = ([(str(n), frozenset(who)) for n, who in s] for s in system_state)
        except (TypeError, ValueError) as error:
            raise ViewError(
                "a system state is [publishers, subscribers, services], each a list of [name, [node, ...]], as the "
                f"Master's getSystemState answers; got {system_state!r:.200}"
            ) from error
        return cls(
            publishers=dict(publishers),
            subscribers=dict(subscribers),
            types={topic: kind for topic, kind in types if kind != "*"},
            nodes=frozenset(node for _, nodes in services for node in nodes),
            unreachable=frozenset(unreachable),
        )


def graph_state(source: object) -> GraphState:
    """Return the state of a `GraphState`, a Master (in process or an XML-RPC proxy), or a graph with a Master.

    Raises:
        ViewError: `source` is something else, or the Master did not answer.

    """
    if isinstance(source, GraphState):
        return source
    if isinstance(source, list | tuple):
        return GraphState.of(source)
    master: Any = source if hasattr(source, "getSystemState") else getattr(source, "master", None)
    if master is None or not hasattr(master, "getSystemState"):
        raise ViewError(
            f"rqt_graph cannot draw a {type(source).__name__}: give it a Master, an object with a `master`, "
            "or a GraphState"
        )
    return GraphState.of(
        _answer(master.getSystemState(CALLER_ID), "getSystemState"),
        _answer(master.getTopicTypes(CALLER_ID), "getTopicTypes"),
        unreachable=getattr(source, "unreachable", ()),
    )


def _answer(reply: Any, method: str) -> Any:
    code, status, value = reply
    if code != 1:
        raise ViewError(f"the Master refused {method}: {status}")
    return value
