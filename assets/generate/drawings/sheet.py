"""A sheet to draw on by hand: boxes, lines and words in the colours of the house, which follow the page's theme."""

from __future__ import annotations

from rosmini.viz.graph_drawing import text
from rosmini.viz.layout import Rect
from rosmini.viz.metrics import text_width
from rosmini.viz.style import HAIRLINE, LABEL_SIZE, LIGHT, LINE_WIDTH, TEXT_SIZE, variable
from rosmini.viz.svg import document, element

LINE = 17.0
"""From one line of text to the next [CSS px]."""


class Sheet:
    """What has been drawn so far; `svg` makes a picture of it.

    `said` has each line of text with the rectangle that it takes up at most, so that tests can see what is too long.
    Lengths are in CSS pixels, y downwards.
    """

    def __init__(self, width: float, height: float) -> None:
        self.width = width
        self.height = height
        self.said: list[tuple[str, Rect]] = []
        self._parts: list[str] = []
        self._css: dict[str, str] = {}
        self._colours: set[str] = set()

    def words(
        self,
        words: str,
        x: float,
        y: float,
        *,
        size: float = TEXT_SIZE,
        colour: str = "ink",
        anchor: str = "start",
        bold: bool = False,
    ) -> None:
        """One line of text, its base line at `y`."""
        width = text_width(words, size) * (1.08 if bold else 1.0)
        left = {"start": x, "middle": x - width / 2, "end": x - width}[anchor]
        self.said.append((words, Rect(left, y - 0.8 * size, width, size)))
        kind = self._class(colour, "fill") + (" rb-bold" if bold else "")
        if bold:
            self._css[".rb-bold"] = "font-weight:bold"
        self._parts.append(text(words, x, y, size=size, colour=colour, anchor=anchor, kind=kind))

    def box(
        self, rect: Rect, fill: str, edge: str, *, corner: float = 6.0, lines: tuple[str, ...] = (), bold: bool = False
    ) -> None:
        """A rectangle with round corners, and lines of text in its middle; the first line is bold if `bold`."""
        kinds = f"{self._class(fill, 'fill')} {self._class(edge, 'stroke')}"
        self._parts.append(
            element(
                "rect",
                x=rect.x,
                y=rect.y,
                width=rect.width,
                height=rect.height,
                rx=corner,
                class_=kinds,
                fill=LIGHT[fill],
                stroke=LIGHT[edge],
                stroke_width=LINE_WIDTH,
            )
        )
        x, y = rect.centre
        for row, line in enumerate(lines):
            down = (row - (len(lines) - 1) / 2) * LINE
            size = TEXT_SIZE if row == 0 else LABEL_SIZE
            self.words(line, x, y + down + 4.5, size=size, anchor="middle", bold=bold and row == 0)

    def line(
        self, start: tuple[float, float], end: tuple[float, float], colour: str = "line", *, dashed: bool = False
    ) -> None:
        """A straight line."""
        self._parts.append(
            element(
                "line",
                x1=start[0],
                y1=start[1],
                x2=end[0],
                y2=end[1],
                class_=self._class(colour, "stroke"),
                stroke=LIGHT[colour],
                stroke_width=HAIRLINE,
                stroke_dasharray="4 3" if dashed else None,
            )
        )

    def dot(self, x: float, y: float, colour: str, radius: float = 4.0) -> None:
        """A point."""
        self._parts.append(
            element("circle", cx=x, cy=y, r=radius, class_=self._class(colour, "fill"), fill=LIGHT[colour])
        )

    def svg(self, title: str, alt: str) -> str:
        """The whole picture, with the text for those who do not see it."""
        css = "".join(f".rosmini-svg {name}{{{body}}}" for name, body in sorted(self._css.items()))
        return document(
            "".join(self._parts),
            width=self.width,
            height=self.height,
            title=title,
            alt=alt,
            css=css,
            colours=sorted(self._colours),
        )

    def _class(self, colour: str, what: str) -> str:
        name = f"rb-{what}-{colour}"
        self._css[f".{name}"] = f"{what}:{variable(colour)}"
        self._colours.add(colour)
        return name
