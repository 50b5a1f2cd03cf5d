"""Boxes and arrows: who hands something on to whom."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from rosmini.viz.graph_drawing import arrow, drawing, rule
from rosmini.viz.layout import Edge, Rect, Vertex, layered
from rosmini.viz.layout.model import Direction
from rosmini.viz.metrics import text_width
from rosmini.viz.style import LABEL_SIZE, LIGHT, LINE_WIDTH, TEXT_SIZE
from rosmini.viz.svg import element, escape

HEIGHT = 44.0
CSS = (
    rule(".rb-topic rect", fill="topic-fill", stroke="topic-line")
    + rule(".rb-node rect", fill="node-fill", stroke="node-line")
    + rule("g text", fill="ink")
    + rule("g .rb-what", fill="muted")
    + rule(".rb-way path:first-of-type", stroke="line")
    + rule(".rb-way path:last-of-type", fill="line")
)
COLOURS = ["ink", "line", "muted", "node-fill", "node-line", "topic-fill", "topic-line"]

Boxes = Sequence[tuple[str, str]]
"""What each box says: its name, and a line about it."""
Ways = Sequence[tuple[str, str]]
"""Arrows, from the name of a box to that of another."""


def flow(
    boxes: Boxes, ways: Ways, *, marked: Collection[str], title: str, alt: str, direction: Direction = "right"
) -> str:
    """Return a picture of `boxes` joined by `ways`, as SVG; the `marked` ones have another colour."""
    vertices = [Vertex(name, width_of(name, what), HEIGHT) for name, what in boxes]
    edges = [Edge(f"{before} {after}", before, after) for before, after in ways]
    layout = layered(vertices, edges, direction=direction)
    parts = [element("g", arrow(layout.edges[edge.name]), class_="rb-way") for edge in edges]
    parts += [_box(name, what, layout.vertices[name], name in marked) for name, what in boxes]
    return drawing(parts, layout, title=title, alt=alt, css=CSS, colours=COLOURS)


def width_of(name: str, what: str) -> float:
    """How wide a box has to be [CSS px]."""
    return max(text_width(name, TEXT_SIZE), text_width(what, LABEL_SIZE)) + 20


def _box(name: str, what: str, rect: Rect, marked: bool) -> str:
    kind = "topic" if marked else "node"
    box = element(
        "rect",
        x=rect.x,
        y=rect.y,
        width=rect.width,
        height=rect.height,
        rx=8,
        fill=LIGHT[f"{kind}-fill"],
        stroke=LIGHT[f"{kind}-line"],
        stroke_width=LINE_WIDTH,
    )
    x, y = rect.centre
    lines = _line(name, x, y - 3, TEXT_SIZE, "ink") + _line(what, x, y + 14, LABEL_SIZE, "muted", "rb-what")
    return element("g", box + lines, class_=f"rb-{kind}")


def _line(words: str, x: float, y: float, size: float, colour: str, kind: str | None = None) -> str:
    return element(
        "text", escape(words), x=x, y=y, font_size=size, text_anchor="middle", fill=LIGHT[colour], class_=kind
    )
