"""Chains of causes as pictures: the first cause at the top, its effects below."""

from __future__ import annotations

from collections.abc import Sequence

from rosmini.ros.introspection.why import Step, Why
from rosmini.viz import style
from rosmini.viz.graph_drawing import LINE_HEIGHT, MARGIN, arrow, box, rule, text
from rosmini.viz.layout import Rect, Route
from rosmini.viz.metrics import text_width
from rosmini.viz.svg import document, element
from rosmini.viz.view import Picture

COLOURS = ["page", "ink", "line", "muted", "node-fill", "node-line"]
GAP = 30.0
"""Space between two boxes [px]."""
PADDING = 12.0
MAX_LENGTH = 90
"""Maximum number of characters of a line that are shown."""


def why_picture(why: Why, *, title: str | None = None) -> Picture:
    """Draw why something happened: a box for each step, and an arrow from each step to its effect.

    The first box also explains why earlier causes are unknown, and lists what its node received if it acted by itself.

    Args:
        why: the chain of causes.
        title: a caption under the picture.

    """
    steps = [*reversed(why.steps)]
    told = " ".join(f"{step.what}, at {step.time:.3f} s." for step in steps)
    alt = f"Chain of causes, the first one first. {told}"
    boxes = [_lines(step) for step in steps]
    boxes[0] += [why.end.removeprefix("and "), *why.before]
    shown = [[_cut(line) for line in lines] for lines in boxes]
    return Picture(_draw(shown, title or "Why", alt), text=why.text, alt=alt, caption=title)


def _lines(step: Step) -> list[str]:
    return [f"{step.what}, at {step.time:.3f} s", *([step.where] if step.where else [])]


def _cut(line: str) -> str:
    return line if len(line) <= MAX_LENGTH else line[: MAX_LENGTH - 3] + "..."


def _size(lines: Sequence[str]) -> tuple[float, float]:
    sizes = [style.TEXT_SIZE, *[style.LABEL_SIZE] * (len(lines) - 1)]
    width = max(text_width(line, size) for line, size in zip(lines, sizes, strict=True))
    return width + 2 * PADDING, LINE_HEIGHT * len(lines) + 14


def _draw(boxes: Sequence[Sequence[str]], title: str, alt: str) -> str:
    sizes = [_size(lines) for lines in boxes]
    widest = max(width for width, _ in sizes)
    parts, y = [], 0.0
    for lines, (width, height) in zip(boxes, sizes, strict=True):
        if y:
            parts.append(_down(widest / 2, y - GAP, y))
        parts.append(_box(Rect((widest - width) / 2, y, width, height), lines))
        y += height + GAP
    moved = element("g", "".join(parts), transform=f"translate({MARGIN:g},{MARGIN:g})")
    return document(
        moved, width=widest + 2 * MARGIN, height=y - GAP + 2 * MARGIN,
        title=title, alt=alt, css=_css(), colours=COLOURS,
    )  # fmt: skip


def _box(rect: Rect, lines: Sequence[str]) -> str:
    rows = "".join(
        text(
            line, rect.x + PADDING, rect.y + 19 + LINE_HEIGHT * row, anchor=None,
            size=style.LABEL_SIZE if row else style.TEXT_SIZE, colour="muted" if row else "ink",
            kind="rm-where" if row else "rm-what",
        )
        for row, line in enumerate(lines)
    )  # fmt: skip
    return element("g", box(rect, "node", 5) + rows, class_="rm-step")


def _down(x: float, top: float, bottom: float) -> str:
    third = (bottom - top) / 3
    route = Route(((x, top), (x, top + third), (x, bottom - third), (x, bottom)), None)
    return element("g", arrow(route), class_="rm-led")


def _css() -> str:
    return (
        rule(".rm-step rect", fill="node-fill", stroke="node-line")
        + rule(".rm-what", fill="ink")
        + rule(".rm-where", fill="muted")
        + rule(".rm-led path:first-of-type", stroke="line")
        + rule(".rm-led path:last-of-type", fill="line")
        + f".rosmini-svg :is(.rm-step rect,.rm-led path:first-of-type){{stroke-width:{style.LINE_WIDTH}}}"
    )
