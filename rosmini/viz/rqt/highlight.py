"""The highlight of rqt_graph: a node or a topic, and its neighbours.

In rqt_graph the mouse does it (qt_dotgraph: "Highlight connections"): inputs of the chosen node have one
colour, outputs another, and nodes that are both a third.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rosmini.core.errors import nearest
from rosmini.viz.rqt.selection import Selection
from rosmini.viz.view import ViewError


@dataclass(frozen=True)
class Highlight:
    """A node or topic of a drawing, and its neighbours: "chosen", "in", "out" or "both" by the name of the part."""

    name: str
    parts: dict[str, str]

    @property
    def text(self) -> str:
        """The highlight in words."""
        found: dict[str, list[str]] = {"in": [], "out": [], "both": []}
        for part, kind in sorted(self.parts.items()):
            if part[:2] in ("n:", "t:") and kind != "chosen":
                found[kind].append(part[2:])
        words = {"in": "it hears", "out": "it is heard by", "both": "both ways"}
        beside = "; ".join(f"{words[kind]} {', '.join(names)}" for kind, names in found.items() if names)
        return f"highlighted: {self.name}; {beside or 'nothing is beside it'}"


def highlighted(selection: Selection, name: str) -> Highlight:
    """Return what to highlight for a node or a topic that is drawn.

    Raises:
        ViewError: it is not drawn; the message names the nearest.

    """
    known = (*selection.nodes, *selection.topics)
    if name not in known:
        hint = nearest(name, known) or f"there are {', '.join(known) or 'none'}"
        raise ViewError(f"rqt_graph draws no {name!r:.80} that could be highlighted; {hint}")
    parts = {f"n:{name}" if name in selection.nodes else f"t:{name}": "chosen"}
    for arrow, source, target, label in _arrows(selection):
        if name not in (source[2:], target[2:], label):
            continue
        kind = "in" if target[2:] == name else "out"
        parts[arrow] = "both" if label == name else kind
        for end, side in ((source, "in"), (target, "out")):
            if end[2:] != name:
                parts[end] = side if parts.get(end, side) == side else "both"
    return Highlight(name, parts)


def _arrows(selection: Selection) -> Iterator[tuple[str, str, str, str]]:
    """Yield the name of each arrow in the drawing, its ends, and its label."""
    if selection.mode == "nodes_only":
        for publisher, topic, subscriber in selection.connections:
            yield f"{publisher} {topic} {subscriber}", f"n:{publisher}", f"n:{subscriber}", topic
    else:
        for node, topic in selection.publications:
            yield f"p:{node} {topic}", f"n:{node}", f"t:{topic}", ""
        for node, topic in selection.subscriptions:
            yield f"s:{topic} {node}", f"t:{topic}", f"n:{node}", ""
