"""The graph in words: the text form, which is complete, and the alt text, which is a sentence."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from rosmini.viz.rqt.selection import Selection
from rosmini.viz.words import plural

ALT_FLOWS = 6
"""Number of topics that the alt text contains."""


def text_form(selection: Selection, title: str | None = None) -> str:
    """Return counts, a line for each flow `publishers -> topic [type] -> subscribers`, and lone nodes."""
    head = f"{title or 'rqt_graph'}: {_counts(selection)}"
    hidden = [
        plural(count, noun)
        for count, noun in ((selection.hidden_nodes, "node"), (selection.hidden_topics, "topic"))
        if count
    ]
    lines = [head + (f" (hidden: {' and '.join(hidden)})" if hidden else "")]
    flows = _flows(selection)
    for publishers, topic, subscribers in flows:
        source = ", ".join(publishers) or "(no publisher)"
        sink = ", ".join(subscribers) or "(no subscriber)"
        lines.append(f"{source} -> {topic}{_type(selection, topic)} -> {sink}")
    connected = {name for publishers, _, subscribers in flows for name in (*publishers, *subscribers)}
    lines += [f"{node} (not connected)" for node in selection.nodes if node not in connected]
    for name, members in sorted(selection.groups.items()):
        lines.append(f"{name} stands for {', '.join(m + _type(selection, m) for m in members)}")
    lines += [f"{node} does not answer" for node in sorted(selection.unreachable)]
    lines += _changes(selection)
    return "\n".join(lines)


def _changes(selection: Selection) -> list[str]:
    """Return a line with the additions and one with the removals in the drawing."""
    lines = []
    for word, parts in (("new", selection.added), ("gone", selection.removed)):
        found = [part for part in selection.drawn() if part in parts]
        names = [part.partition(":")[2] if part[1] == ":" else part for part in found]
        if names:
            lines.append(f"{word}: {', '.join(name.replace(' ', ' -> ') for name in names)}")
    return lines


def alt_text(selection: Selection) -> str:
    """Describe the picture in a sentence or two."""
    if not selection.nodes and not selection.topics:
        return "Computation graph with nothing to show."
    flows = _flows(selection)
    said = [_clause(*flow) for flow in flows[:ALT_FLOWS]]
    if len(flows) > ALT_FLOWS:
        said.append(f"and {plural(len(flows) - ALT_FLOWS, 'more flow')}")
    start = f"Computation graph with {_counts(selection, ' and ')}"
    if not said:
        return f"{start}: {_listed(selection.nodes)} without a connection."
    sentence = f"{start}: {'; '.join(said)}."
    if selection.unreachable:
        verb = "does" if len(selection.unreachable) == 1 else "do"
        sentence += f" {_listed(sorted(selection.unreachable))} {verb} not answer."
    changes = "; ".join(_changes(selection))
    return f"{sentence} {changes[0].upper()}{changes[1:]}." if changes else sentence


def _counts(selection: Selection, separator: str = ", ") -> str:
    return plural(len(selection.nodes), "node") + separator + plural(len(selection.topics), "topic")


def _type(selection: Selection, topic: str) -> str:
    return f" [{selection.types[topic]}]" if topic in selection.types else ""


def _flows(selection: Selection) -> list[tuple[tuple[str, ...], str, tuple[str, ...]]]:
    """Return (publishers, topic, subscribers), sorted by topic."""
    ends: dict[str, tuple[set[str], set[str]]] = {topic: (set(), set()) for topic in selection.topics}
    if selection.mode == "nodes_only":
        for publisher, topic, subscriber in selection.connections:
            ends[topic][0].add(publisher)
            ends[topic][1].add(subscriber)
    else:
        for role, pairs in enumerate((selection.publications, selection.subscriptions)):
            for node, topic in pairs:
                ends[topic][role].add(node)
    return [(tuple(sorted(sources)), topic, tuple(sorted(sinks))) for topic, (sources, sinks) in sorted(ends.items())]


def _clause(publishers: Collection[str], topic: str, subscribers: Collection[str]) -> str:
    if not publishers:
        return f"nobody publishes {topic} to {_listed(subscribers)}"
    verb = "publishes" if len(publishers) == 1 else "publish"
    sink = f"to {_listed(subscribers)}" if subscribers else "to nobody"
    return f"{_listed(publishers)} {verb} {topic} {sink}"


def _listed(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last
