"""Building blocks for drawings of laid out graphs: shapes, texts, arrows, style rules, and the document around them."""

from __future__ import annotations

from collections.abc import Iterable

from rosmini.viz import style
from rosmini.viz.layout import Layout, Rect, Route
from rosmini.viz.layout.model import Point
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import bezier, document, element, escape, number

MARGIN = 12.0
"""Margin around a drawing [px]."""
LINE_HEIGHT = 15.0
ARROW_LENGTH, ARROW_HALF = 8.5, 3.6


def ellipse(rect: Rect, kind: str) -> str:
    """Return an ellipse in the colours `kind`-fill and `kind`-line."""
    x, y = rect.centre
    return element("ellipse", cx=x, cy=y, rx=rect.width / 2, ry=rect.height / 2, **_paint(kind))


def box(rect: Rect, kind: str, radius: float, shift: float = 0.0) -> str:
    """Return a rectangle with round corners in the colours `kind`-fill and `kind`-line, `shift` to the right and up."""
    return element(
        "rect", x=rect.x + shift, y=rect.y - shift, width=rect.width, height=rect.height, rx=radius, **_paint(kind)
    )


def _paint(kind: str) -> dict[str, str]:
    return {"fill": style.LIGHT[f"{kind}-fill"], "stroke": style.LIGHT[f"{kind}-line"]}


def text(
    words: str,
    x: float,
    y: float,
    *,
    size: float | None = style.TEXT_SIZE,
    colour: str = "ink",
    anchor: str | None = "middle",
    kind: str | None = None,
) -> str:
    """Return a line of text on a baseline; `kind` is its class."""
    return element(
        "text", escape(words), x=x, y=y, class_=kind, font_size=size, text_anchor=anchor, fill=style.LIGHT[colour]
    )


def name(words: str, rect: Rect) -> str:
    """Return a name in the middle of a shape."""
    x, y = rect.centre
    return text(words, x, y + 4.5)


def room_for(lines: list[str]) -> tuple[float, float]:
    """Return the width and height that the text of `facts` needs."""
    return max(text_width(line, style.LABEL_SIZE) for line in lines) + 10, LINE_HEIGHT * len(lines) + 4


def facts(lines: Iterable[str], room: Rect | None) -> str:
    """Return lines of text beside an edge, aligned with the left side of the room for its label."""
    if room is None:
        return ""
    return "".join(
        text(line, room.x + 6, room.y + LINE_HEIGHT * (row + 1) - 2, size=style.LABEL_SIZE, colour="label", anchor=None)
        for row, line in enumerate(lines)
    )


def arrow(route: Route, colour: str = "line", width: float | None = None) -> str:
    """Return the curve of an edge with its arrowhead."""
    points, head = _with_head(route.points)
    paint = style.LIGHT[colour]
    line = element("path", d=bezier(points), fill="none", stroke=paint, stroke_width=width)
    return line + element("path", d=head, fill=paint)


def _with_head(points: tuple[Point, ...]) -> tuple[tuple[Point, ...], str]:
    """Return the curve, cut off at its arrowhead, and the outline of the arrowhead."""
    tip, before = points[-1], points[-2]
    dx, dy = tip[0] - before[0], tip[1] - before[1]
    length = (dx * dx + dy * dy) ** 0.5
    if length < 0.05:
        dx, dy = tip[0] - points[0][0], tip[1] - points[0][1]
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
    ux, uy = dx / length, dy / length
    base = (tip[0] - ux * ARROW_LENGTH, tip[1] - uy * ARROW_LENGTH)
    left = (base[0] - uy * ARROW_HALF, base[1] + ux * ARROW_HALF)
    right = (base[0] + uy * ARROW_HALF, base[1] - ux * ARROW_HALF)
    outline = "M" + "L".join(f"{number(x)},{number(y)}" for x, y in (tip, left, right)) + "Z"
    neck = (tip[0] - ux * (ARROW_LENGTH - 1.5), tip[1] - uy * (ARROW_LENGTH - 1.5))
    return (*points[:-1], neck), outline


def rule(selector: str, **properties: str) -> str:
    """Return a style rule; the properties are colours of the palette."""
    body = ";".join(f"{name}:{style.variable(value)}" for name, value in properties.items())
    return f".rosmini-svg {selector}{{{body}}}"


def drawing(parts: Iterable[str], layout: Layout, *, title: str, alt: str, css: str, colours: list[str]) -> str:
    """Return the document of a drawing, with a margin around it."""
    moved = element("g", "".join(parts), transform=f"translate({number(MARGIN)},{number(MARGIN)})")
    width, height = layout.width + 2 * MARGIN, layout.height + 2 * MARGIN
    return document(moved, width=width, height=height, title=title, alt=alt, css=css, colours=colours)
