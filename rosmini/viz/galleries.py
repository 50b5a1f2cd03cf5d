"""Views side by side: one figure, one text, one alt text. On a narrow page they are placed one below the other."""

from __future__ import annotations

import re
from math import ceil

from rosmini.viz.figures import WIDTH
from rosmini.viz.style import LABEL_SIZE, LIGHT
from rosmini.viz.svg import document, element, escape
from rosmini.viz.view import SVG_MIME, View, ViewError

GAP = 16.0
"""Space between two views [CSS px]."""
MIN_WIDTH = 240.0
"""Minimum width of a view, unless the page is narrower [CSS px]."""
KIND = "rosmini-grid"

_SIZE = re.compile(r'viewBox="0 0 ([\d.]+) ([\d.]+)"')


def grid(*views: View, columns: int = 2, title: str | None = None) -> View:
    """Put views side by side: pictures, and views that move or turn, each with its caption.

    Args:
        views: the views, from left to right, row by row; for two in the book's column, make them `width=320`.
        columns: the number of columns, where the page is wide enough.
        title: a caption under all of them, and the first words of the text form.

    Raises:
        ViewError: there are no views, `columns` is not positive, or a view has no vector form (camera images have
            none).

    """
    if not views or columns < 1:
        raise ViewError(f"a grid needs at least one view and one column, not {len(views)} views in {columns} columns")
    for view in views:
        if view.html is None or _svg_of(view) is None:
            first = view.text.partition("\n")[0]
            raise ViewError(f"{first!r} has no vector form (SVG), so it cannot be part of a grid; show it by itself")
    return _Grid(views, min(columns, len(views)), title)


class _Grid(View):
    def __init__(self, views: tuple[View, ...], columns: int, title: str | None) -> None:
        self._views, self._columns, self._title = views, columns, title

    @property
    def text(self) -> str:
        head = f"{self._title or 'grid'}: {len(self._views)} views"
        return "\n".join([head, *(view.text for view in self._views)])

    @property
    def alt(self) -> str:
        return " ".join(f"{i}. {view.alt}" for i, view in enumerate(self._views, 1))

    def _images(self) -> dict[str, bytes]:
        return {SVG_MIME: self._svg().encode()}

    def _svg(self) -> str:
        """Return all views as one document: each as wide as its column, each row as high as its highest view."""
        wide = (WIDTH - GAP * (self._columns - 1)) / self._columns
        drawn = [_svg_of(view) or "" for view in self._views]
        heights = [wide * _size(svg)[1] / _size(svg)[0] for svg in drawn]
        words = [getattr(view, "caption", None) or "" for view in self._views]
        below = 2 * LABEL_SIZE if any(words) else 0.0
        body, top = "", 0.0
        for row in range(ceil(len(drawn) / self._columns)):
            cells = range(row * self._columns, min((row + 1) * self._columns, len(drawn)))
            high = max(heights[i] for i in cells)
            for i in cells:
                left = (i - cells[0]) * (wide + GAP)
                body += _placed(drawn[i], left, top, wide, heights[i])
                if words[i]:
                    at = {"x": left + wide / 2, "y": top + high + 1.3 * LABEL_SIZE}
                    body += element("text", escape(words[i]), **at, text_anchor="middle", class_="under")
            top += high + below + GAP
        css = f".{KIND} .under{{font-size:{LABEL_SIZE}px;fill:var(--rosmini-muted, {LIGHT['muted']})}}"
        title = self.text.partition("\n")[0]
        return document(
            body, width=WIDTH, height=top - GAP, title=title, alt=self.alt, css=css, colours=["muted"], kind=KIND
        )

    @property
    def html(self) -> str:
        """The views' own figures in one figure, in as many columns as the page has room for."""
        each = f"max({MIN_WIDTH:g}px, calc({100 / self._columns:.4g}% - {GAP:g}px))"
        cells = "".join(f'<div style="min-width:0">{view.html}</div>' for view in self._views)
        columns = f"grid-template-columns:repeat(auto-fit,minmax(min(100%,{each}),1fr))"
        inner = f'<div style="display:grid;align-items:end;gap:0 {GAP:g}px;{columns}">{cells}</div>'
        caption = element("figcaption", escape(self._title)) if self._title else ""
        return element("figure", inner + caption, class_=f"rosmini-figure {KIND}", role="group", style="margin:0.5em 0")


def _svg_of(view: View) -> str | None:
    return view._repr_mimebundle_(include={SVG_MIME})[0].get(SVG_MIME)


def _size(svg: str) -> tuple[float, float]:
    found = _SIZE.search(svg)
    if found is None:  # each of our pictures has one
        raise ViewError("an SVG without a viewBox cannot be part of a grid")
    return float(found[1]), float(found[2])


def _placed(svg: str, left: float, top: float, wide: float, high: float) -> str:
    """Return an SVG document as a nested element at a position, without its own size and style."""
    head, _, rest = svg.partition(">")
    head = re.sub(r' (?:width|height|style)="[^"]*"', "", head)
    return f'{head} x="{left:.1f}" y="{top:.1f}" width="{wide:.1f}" height="{high:.1f}">{rest}'
