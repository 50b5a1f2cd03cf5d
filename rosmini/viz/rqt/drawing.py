"""Draw a selection as SVG: nodes as ovals, topics as labels on edges or as boxes, namespaces as boxes around them."""

from __future__ import annotations

from rosmini.viz import style
from rosmini.viz.graph_drawing import LINE_HEIGHT, MARGIN, arrow, box, drawing, ellipse, rule, text
from rosmini.viz.graph_drawing import name as label_of
from rosmini.viz.layout import Edge, Layout, Rect, Route, Vertex, layered
from rosmini.viz.layout.model import Direction
from rosmini.viz.metrics import text_width
from rosmini.viz.rqt.highlight import Highlight
from rosmini.viz.rqt.selection import Selection
from rosmini.viz.svg import document, element, escape

COLOURS = [
    "ink", "muted", "line", "node-fill", "node-line", "topic-fill", "topic-line",
    "group-fill", "group-line", "label", "bad-fill", "bad-line",
]  # fmt: skip

CHANGES = (
    ".rosmini-svg .rm-new ellipse,.rosmini-svg .rm-new rect,.rosmini-svg .rm-new path:first-of-type{stroke-width:3.2}"
    ".rosmini-svg .rm-new text{font-weight:bold}"
    ".rosmini-svg .rm-gone{opacity:0.6}"
    ".rosmini-svg .rm-gone ellipse,.rosmini-svg .rm-gone rect,.rosmini-svg .rm-gone path:first-of-type"
    "{stroke-dasharray:6 4}"
)
"""Additions since an earlier state are bold, removals pale and dashed."""


def _lit(kind: str, colour: str) -> str:
    scope, ink = f".rosmini-svg .rm-{kind}", style.variable(colour)
    return (
        f"{scope} ellipse,{scope} rect,{scope} path:first-of-type{{stroke:{ink};stroke-width:2.8}}"
        f"{scope} path:last-of-type{{fill:{ink}}}{scope} text{{font-weight:bold}}"
    )


LIT = {"chosen": "vermilion", "in": "blue", "out": "green", "both": "purple"}
HIGHLIGHTS = ".rosmini-svg .rm-pale{opacity:0.35}" + "".join(_lit(*each) for each in LIT.items())
"""Colours of the highlighted node or topic (chosen), its inputs (in) and its outputs (out); all others are pale."""


def draw(
    selection: Selection,
    *,
    namespaces: int,
    direction: Direction,
    title: str,
    alt: str,
    highlight: Highlight | None = None,
) -> str:
    """Return the SVG of a selection. `namespaces` is the depth of nested boxes around namespaces; 0 draws none."""
    vertices, edges, labels = _graph(selection, namespaces)
    names = [*(vertex.name for vertex in vertices), *(edge.name for edge in edges)]
    looks = dict.fromkeys(names, " rm-pale") if highlight else {}
    looks |= {part: f" rm-{kind}" for part, kind in highlight.parts.items()} if highlight else {}
    layout = layered(vertices, edges, direction=direction)
    if not vertices:
        return _nothing(title, alt)
    groups = sorted(layout.groups.items(), key=lambda group: (len(group[0]), group[0]))
    parts = [_group(path, rect) for path, rect in groups]
    parts += [
        _edge(layout.edges[edge.name], edge, labels, _change(edge.name, selection) + looks.get(edge.name, ""))
        for edge in sorted(edges, key=lambda e: e.name)
    ]
    parts += [
        _vertex(vertex, layout, selection, looks.get(vertex.name, ""))
        for vertex in sorted(vertices, key=lambda v: v.name)
    ]
    parts += [_group_name(path, rect) for path, rect in groups]
    css = _css() + (CHANGES if selection.added or selection.removed else "") + (HIGHLIGHTS if highlight else "")
    colours = COLOURS + ([*LIT.values()] if highlight else [])
    return drawing(parts, layout, title=title, alt=alt, css=css, colours=colours)


def _graph(selection: Selection, namespaces: int) -> tuple[list[Vertex], list[Edge], dict[str, str]]:
    """Return vertices, edges, and the labels of edges. `n:` and `t:` distinguish nodes and topics of equal names."""
    edges: list[Edge] = []
    labels: dict[str, str] = {}
    if selection.mode == "nodes_only":
        for publisher, topic, subscriber in selection.connections:
            name = f"{publisher} {topic} {subscriber}"
            labels[name] = topic
            width = text_width(topic, style.LABEL_SIZE) + 6
            edges.append(Edge(name, f"n:{publisher}", f"n:{subscriber}", width, LINE_HEIGHT))
    else:
        edges += [Edge(f"p:{n} {t}", f"n:{n}", f"t:{t}") for n, t in selection.publications]
        edges += [Edge(f"s:{t} {n}", f"t:{t}", f"n:{n}") for n, t in selection.subscriptions]
    vertices = [_sized(f"n:{n}", "ellipse", edges, namespaces) for n in selection.nodes]
    if selection.mode != "nodes_only":
        vertices += [_sized(f"t:{t}", "box", edges, namespaces) for t in selection.topics]
    return vertices, edges, labels


def _sized(name: str, shape: str, edges: list[Edge], namespaces: int) -> Vertex:
    label = name[2:]
    width = text_width(label, style.TEXT_SIZE)
    busiest = max(
        sum(1 for e in edges if e.source == name != e.target), sum(1 for e in edges if e.target == name != e.source)
    )
    groups = tuple(_namespaces(label)[:namespaces])
    if shape == "ellipse":
        height = min(120.0, max(36.0, 14 + 9.0 * busiest))
        return Vertex(name, max(64.0, width + 34, 1.2 * height), height, "ellipse", groups)
    return Vertex(name, max(40.0, width + 18), min(110.0, max(28.0, 10 + 9.0 * busiest)), "box", groups)


def _namespaces(name: str) -> list[str]:
    """Return the namespaces of a name: `/a` and `/a/b` for `/a/b/c`."""
    parts = name.split("/")[1:-1]
    return ["/" + "/".join(parts[: i + 1]) for i in range(len(parts))]


def _vertex(vertex: Vertex, layout: Layout, selection: Selection, look: str) -> str:
    rect = layout.vertices[vertex.name]
    name = vertex.name[2:]
    if vertex.shape == "ellipse":
        bad = name in selection.unreachable
        shape = ellipse(rect, "bad" if bad else "node")
        kind, tip = ("node rm-bad", f"{name} does not answer") if bad else ("node", f"node {name}")
    else:
        members = selection.groups.get(name, ())
        shape = "".join(box(rect, "topic", 4.0, shift) for shift in ((4.0, 0.0) if members else (0.0,)))
        kind = "topic"
        tip = f"topic {name}" + (f" [{selection.types[name]}]" if name in selection.types else "")
        if members:
            tip = f"{name}: {', '.join(members)}"
    kind += _change(vertex.name, selection) + look
    return element("g", element("title", escape(tip)) + shape + label_of(name, rect), class_=f"rm-{kind}")


def _change(part: str, selection: Selection) -> str:
    """Return the CSS class of a part that was added or removed since an earlier state."""
    return " rm-new" if part in selection.added else " rm-gone" if part in selection.removed else ""


def _edge(route: Route, edge: Edge, labels: dict[str, str], change: str) -> str:
    source, target = edge.source[2:], edge.target[2:]
    topic = labels.get(edge.name)
    tip = f"{source} -> {topic} -> {target}" if topic else f"{source} -> {target}"
    label = ""
    if topic and route.label:
        x, _ = route.label.centre
        label = text(topic, x, route.label.bottom - 3, size=style.LABEL_SIZE, colour="label")
    return element("g", element("title", escape(tip)) + arrow(route) + label, class_=f"rm-edge{change}")


def _group(path: tuple[str, ...], rect: Rect) -> str:
    return element("g", element("title", escape(f"namespace {path[-1]}")) + box(rect, "group", 8.0), class_="rm-group")


def _group_name(path: tuple[str, ...], rect: Rect) -> str:
    """Draw the name of a namespace over the edges that cross it, with a halo that keeps it legible."""
    return element(
        "text",
        escape(path[-1]),
        class_="rm-group-name",
        x=rect.x + 9,
        y=rect.y + 14.5,
        font_size=11.5,
        fill=style.LIGHT["muted"],
        stroke=style.LIGHT["group-fill"],
        stroke_width=4.0,
        stroke_linejoin="round",
        paint_order="stroke",
    )


def _nothing(title: str, alt: str) -> str:
    message = "(no node to show)"
    width = text_width(message, style.TEXT_SIZE) + 6 * MARGIN
    label = text(message, width / 2, 34.0, colour="muted", kind="rm-none")
    return document(label, width=width, height=60.0, title=title, alt=alt, css=_css(), colours=COLOURS)


def _css() -> str:
    return (
        rule(".rm-node ellipse", fill="node-fill", stroke="node-line")
        + rule(".rm-bad ellipse", fill="bad-fill", stroke="bad-line").replace("}", ";stroke-dasharray:5 3}")
        + rule(".rm-topic rect", fill="topic-fill", stroke="topic-line")
        + rule(".rm-group rect", fill="group-fill", stroke="group-line")
        + rule(".rm-group-name", fill="muted", stroke="group-fill")
        + rule(".rm-node text,.rosmini-svg .rm-topic text", fill="ink")
        + rule(".rm-edge text", fill="label")
        + rule(".rm-none", fill="muted")
        + rule(".rm-edge path:first-of-type", stroke="line")
        + rule(".rm-edge path:last-of-type", fill="line")
        + f".rosmini-svg path:first-of-type,.rosmini-svg ellipse{{stroke-width:{style.LINE_WIDTH}}}"
        + f".rosmini-svg rect{{stroke-width:{style.HAIRLINE}}}"
        + ".rosmini-svg .rm-edge:hover path:first-of-type{stroke-width:2.8}"
        + ".rosmini-svg .rm-edge:hover text{font-weight:bold}"
    )
