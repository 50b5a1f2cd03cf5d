"""The inside of a `move_base` as a picture: its loaded plugins, and the nodes that they receive from or send to."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any

from rosmini.navigation.move_base.parts import Part, Structure, structure_of
from rosmini.viz import style
from rosmini.viz.graph_drawing import LINE_HEIGHT, arrow, box, drawing, ellipse, rule, text
from rosmini.viz.graph_drawing import name as label_of
from rosmini.viz.layout import Edge, Layout, Rect, Vertex, layered
from rosmini.viz.metrics import text_width
from rosmini.viz.rqt.graph_state import GraphState, graph_state
from rosmini.viz.svg import element
from rosmini.viz.view import Picture

COLOURS = [
    "ink", "muted", "line", "label", "node-fill", "node-line", "topic-fill", "topic-line", "group-fill", "group-line",
]  # fmt: skip
COMMANDED = " "
"""Suffix of the name of a node that receives commands: it is drawn a second time, below, so that arrows lead down."""
Arrow = tuple[str, str, str]
"""(from, to, topics): names of nodes or of parts."""


def move_base_picture(move_base: Any, *, title: str | None = None) -> Picture:
    """Draw the parts of a running `move_base`, and its connections to the outside.

    Ovals are other nodes, with the topics that they publish or subscribe to; a node that is commanded appears again
    below. A topic without another publisher appears by itself, like the topic of goals until a program sends one.
    Boxes are parts: the loaded planners, layers and recovery behaviours, under their ROS names. Publications without
    subscribers, and parameters, are left out.

    Args:
        move_base: the program of the node, `graph.nodes["/move_base"].program`.
        title: a caption under the picture, and the first words of its text form.

    """
    name = move_base.node.name
    found = structure_of(move_base)
    state = graph_state(move_base.node.graph)
    arrows = [*found.links, *_outside(name, found, state)]
    head = f"{title or f'Inside {name}'}: {len(found.parts)} parts"
    lines = [f"  {part.name}: {', '.join(part.lines)}" for part in found.parts]
    lines += [f"  {source} -> {target.rstrip()}{': ' * bool(what)}{what}" for source, target, what in arrows]
    alt = f"What {name} is made of: {'; '.join(', '.join(part.lines) for part in found.parts)}."
    svg = _draw(name, found, arrows, state, title or f"Inside {name}", alt)
    return Picture(svg, text="\n".join([head, *lines]), alt=alt, caption=title)


def _outside(name: str, found: Structure, state: GraphState) -> list[Arrow]:
    """Return the arrows between other nodes and the parts; the topics between the same two share an arrow."""
    single = sorted({each for part in found.parts for each in _ends(name, part, state)})
    return [
        (source, target, ", ".join(topic for _, _, topic in group))
        for (source, target), group in groupby(single, key=lambda each: each[:2])
    ]


def _ends(name: str, part: Part, state: GraphState) -> Iterator[Arrow]:
    """Yield every (from, to, topic) of a part and another node; a topic without a publisher is itself the source."""
    heard = {topic: state.publishers.get(topic, frozenset()) - {name} for topic in part.subscribes}
    for topic, publishers in heard.items():
        yield from ((publisher, part.name, topic) for publisher in publishers)
    if heard and not any(heard.values()):
        yield from ((topic, part.name, "") for topic in heard)
    for topic in part.publishes:
        yield from ((part.name, node + COMMANDED, topic) for node in state.subscribers.get(topic, frozenset()) - {name})


def _draw(name: str, found: Structure, arrows: list[Arrow], state: GraphState, title: str, alt: str) -> str:
    parts = {part.name: part for part in found.parts}
    others = sorted({end for source, target, _ in arrows for end in (source, target)} - set(parts))
    vertices = [_room(part, name) for part in found.parts]
    nodes = state.all_nodes
    vertices += [_oval(other) if other.rstrip() in nodes else _topic(other) for other in others]
    edges = [_edge(each) for each in arrows]
    layout = layered(vertices, edges, direction="down")
    drawn = [element("g", box(rect, "group", 8.0), class_="rm-group") for rect in layout.groups.values()]
    drawn += [_arrow(layout, edge, what) for edge, (_, _, what) in zip(edges, arrows, strict=True)]
    for vertex in vertices:
        rect = layout.vertices[vertex.name]
        drawn.append(_part(parts[vertex.name], rect) if vertex.name in parts else _other(vertex, rect))
    drawn += [_group_name(name, rect) for rect in layout.groups.values()]
    return drawing(drawn, layout, title=title, alt=alt, css=_css(), colours=COLOURS)


def _room(part: Part, name: str) -> Vertex:
    first, *rest = part.lines
    width = max([text_width(first, style.TEXT_SIZE), *(text_width(line, style.LABEL_SIZE) for line in rest)])
    return Vertex(part.name, width + 20, LINE_HEIGHT * len(part.lines) + 12, "box", (name,))


def _oval(name: str) -> Vertex:
    return Vertex(name, text_width(name, style.TEXT_SIZE) + 34, 36.0, "ellipse")


def _topic(name: str) -> Vertex:
    return Vertex(name, text_width(name, style.TEXT_SIZE) + 18, 28.0)


def _edge(each: Arrow) -> Edge:
    source, target, what = each
    room = (text_width(what, style.LABEL_SIZE) + 8, LINE_HEIGHT) if what else (0.0, 0.0)
    return Edge(f"{source} {target}", source, target, *room)


def _part(part: Part, rect: Rect) -> str:
    first, *rest = part.lines
    x, _ = rect.centre
    rows = text(first, x, rect.y + 18)
    rows += "".join(
        text(line, x, rect.y + 18 + LINE_HEIGHT * row, size=style.LABEL_SIZE, colour="muted", kind="rm-what")
        for row, line in enumerate(rest, 1)
    )
    return element("g", box(rect, "topic", 5.0) + rows, class_="rm-part")


def _other(vertex: Vertex, rect: Rect) -> str:
    if vertex.shape == "ellipse":
        return element("g", ellipse(rect, "node") + label_of(vertex.name.rstrip(), rect), class_="rm-node")
    return element("g", box(rect, "group", 4.0) + label_of(vertex.name, rect), class_="rm-topic")


def _arrow(layout: Layout, edge: Edge, what: str) -> str:
    route = layout.edges[edge.name]
    label = ""
    if what and route.label:
        x, _ = route.label.centre
        label = text(what, x, route.label.bottom - 3, size=style.LABEL_SIZE, colour="label")
    return element("g", arrow(route) + label, class_="rm-edge")


def _group_name(name: str, rect: Rect) -> str:
    return text(name, rect.x + 9, rect.y + 14.5, size=style.LABEL_SIZE, colour="muted", anchor=None, kind="rm-what")


def _css() -> str:
    return (
        rule(".rm-node ellipse", fill="node-fill", stroke="node-line")
        + rule(".rm-part rect", fill="topic-fill", stroke="topic-line")
        + rule(".rm-group rect,.rosmini-svg .rm-topic rect", fill="group-fill", stroke="group-line")
        + rule("g text", fill="ink")
        + rule("text.rm-what", fill="muted")
        + rule(".rm-edge text", fill="label")
        + rule(".rm-edge path:first-of-type", stroke="line")
        + rule(".rm-edge path:last-of-type", fill="line")
        + f".rosmini-svg path:first-of-type,.rosmini-svg ellipse{{stroke-width:{style.LINE_WIDTH}}}"
        + f".rosmini-svg rect{{stroke-width:{style.HAIRLINE}}}"
    )
