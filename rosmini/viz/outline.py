"""A tree drawn as an outline: an indented row for each entry, with lines from each entry to its parent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rosmini.viz import style
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import document, element, escape

MARGIN, ROW, STEP, GAP = 12.0, 24.0, 24.0, 14.0
COLOURS = ["ink", "muted", "group-line", "node-line", "topic-fill", "topic-line"]

HEAD, NAME, VALUE, KIND = "pt-namespace", "pt-name", "pt-value", "pt-kind"
"""The styles of a cell: bold, plain, in colour, or muted and slanted."""


@dataclass(frozen=True)
class Row:
    """An entry: its depth, the index of its parent's row (-1 for none), and its cells."""

    depth: int
    parent: int
    cells: tuple[tuple[str, str], ...]


def outline(rows: Sequence[Row], title: str, alt: str) -> str:
    """Return the SVG of a tree."""
    parts: list[str] = []
    width = 200.0
    for number, row in enumerate(rows):
        x, y = MARGIN + STEP * row.depth, MARGIN + ROW * (number + 0.5)
        if row.parent >= 0:
            trunk, top = x - STEP + 6, MARGIN + ROW * (row.parent + 0.5) + 9
            parts.append(element("path", d=f"M{trunk:.1f},{top:.1f}V{y:.1f}H{x - 4:.1f}", class_="pt-line"))
        for kind, text in row.cells:
            parts.append(element("text", escape(text), x=x, y=y + 4.5, class_=kind))
            x += text_width(text, style.TEXT_SIZE) * (1.08 if kind == HEAD else 1.0) + GAP
        width = max(width, x + MARGIN)
    css = (
        f".pt-line{{fill:none;stroke:{style.variable('group-line')};stroke-width:{style.HAIRLINE};"
        "shape-rendering:crispEdges}"
        f".rosmini-svg text{{font-size:{style.TEXT_SIZE}px;fill:{style.variable('ink')}}}"
        ".rosmini-svg .pt-namespace{font-weight:700}"
        f".rosmini-svg .pt-value{{fill:{style.variable('node-line')}}}"
        f".rosmini-svg .pt-kind{{fill:{style.variable('muted')};font-style:italic}}"
    )
    height = ROW * len(rows) + 2 * MARGIN
    return document("".join(parts), width=width, height=height, title=title, alt=alt, css=css, colours=COLOURS)
