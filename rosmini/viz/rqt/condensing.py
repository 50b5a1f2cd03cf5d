"""Condense a large graph: similar nodes and topics become one box, until reader and layout can cope.

Nodes are grouped by ever weaker similarity: the same topics in the same roles; names that differ only in
numbers; the same outermost namespace; neighbours in the alphabet. Topics are grouped if they have the same
publishers and the same subscribers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import replace
from math import isqrt

from rosmini.viz.rqt.selection import Selection

LIMIT = 300
"""Maximum number of nodes, topics and arrows that are drawn one by one."""

Grouping = Callable[[Selection], Mapping[str, Hashable]]
"""Keys of nodes: nodes with equal keys become one box."""


def condensed(selection: Selection, limit: int = LIMIT) -> Selection:
    """Return a small selection unchanged, and a large one as groups, whose members are in `Selection.bundles`."""
    if _size(selection) <= limit:
        return selection
    likenesses: tuple[Grouping, ...] = (_by_topics, _by_numbers, _by_namespace, _by_alphabet)
    small = _merge_topics(selection)
    for likeness in likenesses:
        if _size(small) <= limit:
            break
        small = _merge_topics(_merge_nodes(small, likeness(small)))
    return small


def _size(selection: Selection) -> int:
    if selection.mode == "nodes_only":
        return len(selection.nodes) + len(selection.connections)
    ends = len(selection.publications) + len(selection.subscriptions)
    return len(selection.nodes) + len(selection.topics) + ends


def _by_topics(selection: Selection) -> Mapping[str, Hashable]:
    roles: dict[str, tuple[list[str], list[str]]] = {node: ([], []) for node in selection.nodes}
    for role, ends in enumerate((selection.publications, selection.subscriptions)):
        for node, topic in ends:
            roles[node][role].append(topic)
    return {node: (tuple(out), tuple(into)) for node, (out, into) in roles.items()}


def _by_numbers(selection: Selection) -> Mapping[str, Hashable]:
    return {node: re.sub(r"\d+", "#", node) for node in selection.nodes}


def _by_namespace(selection: Selection) -> Mapping[str, Hashable]:
    return {node: node.split("/")[1] if node.count("/") > 1 else "" for node in selection.nodes}


def _by_alphabet(selection: Selection) -> Mapping[str, Hashable]:
    blocks = isqrt(LIMIT) // 2
    size = -(-len(selection.nodes) // blocks)
    return {node: i // size for i, node in enumerate(sorted(selection.nodes))}


def _merge_nodes(selection: Selection, key: Mapping[str, Hashable]) -> Selection:
    names, bundles = _bundle(selection.nodes, key, selection.bundles, "nodes")
    links = {(names[p], topic, names[s]) for p, topic, s in selection.connections}
    silent = {name for node, name in names.items() if node in selection.unreachable}
    return replace(
        selection,
        nodes=tuple(sorted(set(names.values()))),
        publications=_renamed(selection.publications, nodes=names),
        subscriptions=_renamed(selection.subscriptions, nodes=names),
        connections=tuple(sorted(links)),
        unreachable=frozenset(silent),
        bundles=bundles,
    )


def _merge_topics(selection: Selection) -> Selection:
    ends: dict[str, set[tuple[str, ...]]] = {topic: set() for topic in selection.topics}
    if selection.mode == "nodes_only":
        for publisher, topic, subscriber in selection.connections:
            ends[topic].add((publisher, subscriber))
    else:
        for role, pairs in (("p", selection.publications), ("s", selection.subscriptions)):
            for node, topic in pairs:
                ends[topic].add((role, node))
    key = {topic: frozenset(found) for topic, found in ends.items()}
    names, bundles = _bundle(ends, key, selection.bundles, "topics")
    return replace(
        selection,
        topics=tuple(sorted(set(names.values()))),
        publications=_renamed(selection.publications, topics=names),
        subscriptions=_renamed(selection.subscriptions, topics=names),
        # If topics are boxes, connections keep the names of the graph: they only show which nodes are connected.
        connections=tuple(sorted({(p, names.get(topic, topic), s) for p, topic, s in selection.connections})),
        bundles=bundles,
    )


def _renamed(
    ends: Iterable[tuple[str, str]], *, nodes: Mapping[str, str] = {}, topics: Mapping[str, str] = {}
) -> tuple[tuple[str, str], ...]:
    found = {(nodes.get(node, node), topics.get(topic, topic)) for node, topic in ends}
    return tuple(sorted(found, key=lambda end: (end[1], end[0])))


def _bundle(
    things: Iterable[str], key: Mapping[str, Hashable], before: Mapping[str, tuple[str, ...]], noun: str
) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
    """Return the new name of each node or topic, and the members of each bundle as the graph names them."""
    alike: dict[Hashable, list[str]] = {}
    for thing in sorted(things):
        alike.setdefault(key[thing], []).append(thing)
    names: dict[str, str] = {}
    bundles = dict(before)
    for members in alike.values():
        name = members[0]
        if len(members) > 1:
            whole = sorted(one for member in members for one in bundles.pop(member, (member,)))
            namespace = whole[0].rpartition("/")[0] + "/"
            name = f"{whole[0]} … {whole[-1].removeprefix(namespace)} ({len(whole)} {noun})"
            bundles[name] = tuple(whole)
        names.update(dict.fromkeys(members, name))
    return names, bundles
