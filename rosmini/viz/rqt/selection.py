"""Select the nodes and topics that rqt_graph shows, by its modes, filters and switches.

The switches and their meaning are those of the rqt_graph package (wiki.ros.org/rqt_graph): the "Hide" row, the "Group"
row and the two filter fields. A `GraphState` becomes a `Selection`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

from rosmini.core.errors import nearest
from rosmini.viz.rqt.graph_state import Connection, GraphState
from rosmini.viz.view import ViewError

Mode = Literal["nodes_only", "nodes_topics_all", "nodes_topics_active"]
Hide = Literal["debug", "dead_sinks", "leaf_topics", "params", "tf", "unreachable"]
MEANING: dict[Hide, str] = {
    "debug": "tools such as rqt itself, and /rosout and /clock",
    "dead_sinks": "topics without subscribers",
    "leaf_topics": "topics with only one connection",
    "params": "topics of dynamic_reconfigure",
    "tf": "the topics of transforms",
    "unreachable": "nodes that do not answer",
}
"""What each switch of the row "Hide" leaves out."""
Group = Literal["actions", "images", "tf"]

DEBUG_NAMES = (
    "/clock",
    "/cpu_monitor",
    "/diag_agg",
    "/hd_monitor",
    "/monitor",
    "/pr2_dashboard",
    "/rosout",
    "/rqt",
    "/runtime_logger",
    "/rviz",
    "/rxloggerlevel",
    "/statistics",
)
""""debug" hides names that contain one of these: the list of rqt_graph."""

DEBUG_TOPICS = ("/time", "/clock", "/rosout", "/statistics")
ACTION_TOPICS = ("cancel", "feedback", "goal", "result", "status")
IMAGE_TOPICS = ("", "/compressed", "/compressedDepth", "/theora")
TF_TOPICS = ("/tf", "/tf_static")


@dataclass(frozen=True)
class Selection:
    """The nodes and topics that are shown.

    `groups` maps the name of a group of topics, as in rqt_graph, to its topics. `hidden_nodes` and `hidden_topics`
    count what switches hide.
    """

    mode: Mode
    nodes: tuple[str, ...]
    topics: tuple[str, ...]
    publications: tuple[tuple[str, str], ...]
    subscriptions: tuple[tuple[str, str], ...]
    connections: tuple[Connection, ...]
    types: dict[str, str]
    unreachable: frozenset[str]
    groups: dict[str, tuple[str, ...]] = field(default_factory=dict)
    hidden_nodes: int = 0
    hidden_topics: int = 0
    added: frozenset[str] = frozenset()
    """Parts (`GraphState.parts`) that an earlier state does not have."""
    removed: frozenset[str] = frozenset()
    """Parts that only an earlier state has."""

    def drawn(self) -> list[str]:
        """Return the nodes, topics and arrows that are drawn, in the form of `GraphState.parts`."""
        nodes = [f"n:{node}" for node in self.nodes]
        if self.mode == "nodes_only":
            return nodes + [" ".join(edge) for edge in self.connections]
        ends = [f"p:{node} {topic}" for node, topic in self.publications]
        ends += [f"s:{topic} {node}" for node, topic in self.subscriptions]
        return nodes + [f"t:{topic}" for topic in self.topics] + ends


def check_choice(what: str, given: Iterable[str], known: object) -> None:
    """Raise an error for an unknown mode or switch, with the nearest name.

    Raises:
        ViewError: it is unknown.

    """
    names = [str(name) for name in get_args(known)]
    for name in given:
        if name not in names:
            hint = nearest(name, names)
            raise ViewError(
                f"rqt_graph has no {what} {name!r}{': ' + hint if hint else ''}. It has {', '.join(names)}."
            )


def matches(name: str, patterns: str) -> bool:
    """Return True if rqt_graph's filter matches a name.

    Commas separate patterns. A plain name matches that name; any other pattern is a regular expression
    that matches from the start; a leading `-` excludes. An empty filter and `/` match every name.

    Raises:
        ViewError: a pattern is not a regular expression.

    """
    parts = [part.strip() for part in patterns.split(",")]
    excluded = [part[1:] for part in parts if part.startswith("-")]
    included = [part for part in parts if part and not part.startswith("-")]
    if included in ([], ["/"]):
        included = [".*"]
    return any(_match(name, p) for p in included) and not any(_match(name, p) for p in excluded)


def _match(name: str, pattern: str) -> bool:
    if re.fullmatch("[a-zA-Z0-9_/]+", pattern):
        return name == pattern
    try:
        return re.match(pattern, name) is not None
    except re.error as error:
        raise ViewError(
            f"the filter {pattern!r} is neither a name nor a regular expression ({error}). "
            "For everything in a namespace write for example /robot1/.*"
        ) from error


def is_debug(name: str) -> bool:
    """Return True if "debug" hides a node or topic of this name: a known tool, or a base name that begins with `_`."""
    return any(part in name for part in DEBUG_NAMES) or name.rsplit("/", 1)[-1].startswith("_")


def select(
    state: GraphState,
    mode: Mode = "nodes_only",
    *,
    hide: Collection[Hide] = (),
    group: Collection[Group] = (),
    nodes: str = "/",
    topics: str = "/",
) -> Selection:
    """Apply filters, switches and grouping.

    Raises:
        ViewError: an unknown mode or switch, or a filter that is not a regular expression.

    """
    check_choice("mode", [mode], Mode)
    check_choice("switch to hide", hide, Hide)
    check_choice("switch to group", group, Group)
    wanted_nodes = [n for n in state.all_nodes if matches(n, nodes)]
    wanted_topics = [t for t in state.topics if matches(t, topics)]
    shown_nodes = [n for n in wanted_nodes if not _hides_node(n, state, hide)]
    shown_topics = _unhidden_topics(state, wanted_topics, hide)
    among, over = set(shown_nodes), set(shown_topics)
    connections = [(p, t, s) for p, t, s in state.edges() if p in among and s in among and t in over]
    connected = {t for _, t, _ in connections}
    switched_off = len(wanted_topics) - len(shown_topics)
    if mode != "nodes_topics_all":
        # Without a connection there is nothing to draw in these two modes.
        shown_topics = [t for t in shown_topics if t in connected]
    publications = _ends(state.publishers, shown_topics, among)
    subscriptions = _ends(state.subscribers, shown_topics, among)
    if mode == "nodes_topics_active":
        sources, sinks = {(p, t) for p, t, _ in connections}, {(s, t) for _, t, s in connections}
        publications = [end for end in publications if end in sources]
        subscriptions = [end for end in subscriptions if end in sinks]
    used = {t for _, t in publications} | {t for _, t in subscriptions}
    shown_topics = [t for t in shown_topics if t in used]
    selection = Selection(
        mode=mode,
        nodes=tuple(shown_nodes),
        topics=tuple(shown_topics),
        publications=tuple(publications),
        subscriptions=tuple(subscriptions),
        connections=tuple(connections),
        types={t: state.types[t] for t in shown_topics if t in state.types},
        unreachable=state.unreachable & set(shown_nodes),
        hidden_nodes=len(wanted_nodes) - len(shown_nodes),
        hidden_topics=switched_off,
    )
    return selection if mode == "nodes_only" else _grouped(selection, group)


def _hides_node(name: str, state: GraphState, hide: Collection[Hide]) -> bool:
    return ("debug" in hide and is_debug(name)) or ("unreachable" in hide and name in state.unreachable)


def _unhidden_topics(state: GraphState, topics: list[str], hide: Collection[Hide]) -> list[str]:
    params = _parameter_topics(state.topics) if "params" in hide else set()

    def hidden(topic: str) -> bool:
        sources, sinks = len(state.publishers.get(topic, ())), len(state.subscribers.get(topic, ()))
        return (
            ("debug" in hide and (is_debug(topic) or topic in DEBUG_TOPICS))
            or ("dead_sinks" in hide and sinks == 0)
            or ("leaf_topics" in hide and sources + sinks < 2)
            or ("tf" in hide and topic in TF_TOPICS)
            or topic in params
        )

    return [topic for topic in topics if not hidden(topic)]


def _parameter_topics(topics: Collection[str]) -> set[str]:
    """Return the topics that dynamic_reconfigure publishes for each server, two each."""
    found = set()
    for topic in topics:
        prefix, _, base = topic.rpartition("/")
        other = f"{prefix}/parameter_descriptions"
        if base == "parameter_updates" and other in topics:
            found |= {topic, other}
    return found


def _ends(side: Mapping[str, frozenset[str]], topics: Collection[str], nodes: Collection[str]) -> list[tuple[str, str]]:
    return [(n, t) for t in topics for n in sorted(side.get(t, ())) if n in nodes]


def _grouped(selection: Selection, group: Collection[Group]) -> Selection:
    """Replace the topics of an action, of an image transport, or of tf by one group."""
    groups: dict[str, tuple[str, ...]] = {}
    topics = set(selection.topics)
    if "actions" in group:
        for topic in selection.topics:
            prefix, _, base = topic.rpartition("/")
            members = {f"{prefix}/{name}" for name in ACTION_TOPICS}
            if base == "feedback" and members <= topics:
                groups[f"{prefix}/action_topics"] = tuple(sorted(members))
    if "images" in group:
        for topic in selection.topics:
            if topic.endswith("/compressed"):
                prefix = topic.removesuffix("/compressed")
                members = {prefix + suffix for suffix in IMAGE_TOPICS} & topics
                if len(members) >= 3:
                    groups[f"{prefix}/image_topics"] = tuple(sorted(members))
    if "tf" in group and set(TF_TOPICS) <= topics:
        groups["/tf"] = TF_TOPICS
    stands_for = {member: name for name, members in groups.items() for member in members}

    def regroup(ends: Iterable[tuple[str, str]]) -> tuple[tuple[str, str], ...]:
        return tuple(sorted({(n, stands_for.get(t, t)) for n, t in ends}, key=lambda end: (end[1], end[0])))

    return replace(
        selection,
        topics=tuple(sorted({stands_for.get(t, t) for t in selection.topics})),
        publications=regroup(selection.publications),
        subscriptions=regroup(selection.subscriptions),
        groups=groups,
    )
