"""Charts of measured shares and lengths, in the book's house style: an interval or the single runs on each line."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from assets.generate.drawings.sheet import Sheet
from rosmini.viz.layout import Rect
from rosmini.viz.metrics import text_width
from rosmini.viz.style import LABEL_SIZE

DRAWINGS = Path(__file__).resolve().parents[3] / "book" / "static" / "drawings"
WIDTH, LABELS, VALUES = 600.0, 230.0, 70.0
"""Width of a chart, least width of the labels at its left, and width of the values at its right [CSS px]."""
HEIGHT, HEAD = 22.0, 20.0
"""Of a line, and of the axis above the first one [CSS px]."""


@dataclass(frozen=True)
class Mark:
    """One line of a chart. With neither an interval nor runs it is the heading of the lines below it."""

    label: str
    value: str = ""
    """What stands at the right."""
    at: float | None = None
    interval: tuple[float, float] | None = None
    runs: tuple[float, ...] = ()


def chart(
    marks: Sequence[Mark],
    ticks: Sequence[float],
    title: str,
    alt: str,
    *,
    shown: Callable[[float], str] = "{:.0%}".format,
) -> str:
    """Draw a chart as SVG. The axis reaches from the first of `ticks` to the last; values outside lie on its ends."""
    sheet = Sheet(WIDTH, HEAD + HEIGHT * len(marks) + 6)
    labels = max([LABELS, *(4 + text_width(mark.label, LABEL_SIZE) for mark in marks)])
    left, right = round(labels) + 8, WIDTH - VALUES - 8

    def x(value: float) -> float:
        share = (value - ticks[0]) / (ticks[-1] - ticks[0])
        return left + min(max(share, 0.0), 1.0) * (right - left)

    for tick in ticks:
        sheet.words(shown(tick), x(tick), 12, size=LABEL_SIZE, colour="muted", anchor="middle")
        sheet.line((x(tick), HEAD), (x(tick), sheet.height), "group-line", dashed=True)
    for place, mark in enumerate(marks):
        y = HEAD + HEIGHT * (place + 0.5) + 2
        heading = mark.at is None and not mark.runs
        sheet.words(mark.label, 4, y + 4, size=LABEL_SIZE, bold=heading)
        sheet.words(mark.value, WIDTH - 4, y + 4, size=LABEL_SIZE, anchor="end")
        if mark.interval is not None:
            low, high = map(x, mark.interval)
            sheet.box(Rect(low, y - 3, max(high - low, 2.0), 6), "node-fill", "node-line", corner=2.0)
        for run in mark.runs:
            sheet.dot(x(run), y, "sky", 2.5)
        if mark.at is not None:
            sheet.dot(x(mark.at), y, "vermilion")
    return sheet.svg(title, alt)


def label(words: str) -> str:
    """The label of a table's row, by which chapters link to it."""
    return re.sub(r"[^a-z0-9]+", "-", words.lower()).strip("-")


def spoken(marks: Sequence[Mark]) -> str:
    """The lines of a chart in words, for readers who do not see it."""
    return "; ".join(f"{mark.label}: {mark.value}" if mark.value else mark.label for mark in marks) + "."


def write(name: str, svg: str) -> None:
    """Store a chart where the pages' directive `drawing` finds it."""
    (DRAWINGS / f"{name}.svg").write_text(svg + "\n", encoding="utf-8", newline="\n")
