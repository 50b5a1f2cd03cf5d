"""Tables in the house style: what the tools of rqt show in rows and columns."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from rosmini.viz.style import themed, variable
from rosmini.viz.svg import element, escape
from rosmini.viz.view import View, ViewError
from rosmini.viz.words import plural

INKS = {"DEBUG": "muted", "INFO": "ink", "WARN": "label", "ERROR": "bad-line", "FATAL": "bad-line"}
"""The colour of each level; its name stands beside it in any case."""

ALT_ROWS = 3
"""How many rows the alt text spells out."""


class Table(View):
    """Rows of texts under titles. A cell that begins with blanks is indented: it is part of the one above.

    Raises:
        ViewError: a row has more or fewer cells than there are columns.

    """

    def __init__(
        self, columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str, noun: str, empty: str = ""
    ) -> None:
        self.columns = tuple(columns)
        self.rows = [tuple(row) for row in rows]
        self.title = title
        self._noun = noun
        self._empty = empty or f"no {noun}"
        wrong = next((row for row in self.rows if len(row) != len(self.columns)), None)
        if wrong is not None:
            raise ViewError(f"a row of this table has {plural(len(self.columns), 'cell')}: {wrong!r:.200}")

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def counted(self) -> str:
        """How many rows there are that are not part of another."""
        return plural(sum(not row[0].startswith(" ") for row in self.rows), self._noun)

    @property
    def text(self) -> str:
        """A line of counts, the titles, and a line for each row."""
        widths = [max(map(len, column)) for column in zip(self.columns, *self.rows, strict=True)]
        lines = [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in (self.columns, *self.rows)
        ]
        return "\n".join([f"{self.title}: {self.counted}", *(f"  {line}" for line in lines if self.rows)])

    @property
    def alt(self) -> str:
        """Counts, titles and the first rows."""
        first = "; ".join(
            ", ".join(cell.strip() for cell in row if cell.strip()) for row in self.rows[:ALT_ROWS]
        )
        return f"Table of {self.title}, {self.counted}; columns {', '.join(self.columns)}. {first}".strip()

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """A `<figure>` with the table, which scrolls by itself where a page is narrow."""
        body = "".join(element("tr", "".join(map(_cell, row))) for row in self.rows)
        if not self.rows:
            body = element("tr", element("td", escape(self._empty), colspan=len(self.columns)))
        return table_figure(
            heading(self.columns), body, caption=f"{self.title} ({self.counted})", label=self.title
        )


def _cell(cell: str) -> str:
    depth = len(cell) - len(cell.lstrip(" "))
    style = f"padding-left:{0.4 + 0.6 * depth:.1f}em" if depth else None
    # A narrow page breaks the long names of ROS where their words end.
    text = re.sub(r"(?<=\w)([/_])(?=\w)", r"\1<wbr>", escape(cell.strip()))
    return element("td", text, style=style)


def heading(titles: Iterable[str]) -> str:
    """Return the row of titles of a table."""
    return element("tr", "".join(element("th", escape(title), scope="col") for title in titles))


def table_figure(head: str, body: str, *, caption: str, label: str) -> str:
    """Return a `<figure>` with a table of these rows; ``label`` is what a screen reader calls it."""
    table = element("table", element("thead", head) + element("tbody", body))
    return element(
        "figure",
        f"<style>{CSS}</style>"
        + element("div", table, class_="rosmini-console", role="region", aria_label=label, tabindex="0")
        + element("figcaption", escape(caption)),
        class_="rosmini-figure",
        style="margin:0.5em 0",
    )


def _rules(selector: str, **properties: str) -> str:
    scoped = ",".join(f".rosmini-console {part}" for part in selector.split(","))
    return (
        f"{scoped}{{{''.join(f'{name}:{value};' for name, value in properties.items()).replace('_', '-')}}}"
    )


CSS = (
    f".rosmini-console{{overflow-x:auto;color:{variable('ink')};}}"
    + _rules(
        "table", border_collapse="collapse", font_size="0.9em", margin="0", min_width="100%", border="none"
    )
    + _rules("tr,tbody tr:nth-child(odd),tbody tr:hover", background="none")
    + _rules(
        "th,td",
        text_align="left",
        vertical_align="top",
        padding="0.25em 0.75em 0.25em 0.4em",
        border="none",
        border_bottom=f"1px solid {variable('group-line')}",
        color="inherit",
    )
    + _rules("th", background=variable("group-fill"), font_weight="600")
    + _rules("td.message", white_space="pre-wrap", min_width="11em", max_width="44em")
    + _rules("td.stamp", font_variant_numeric="tabular-nums")
    + _rules("td.location", color=variable("muted"), white_space="nowrap")
    + _rules("tr.marked td", background=variable("topic-fill"))
    + _rules("td.FATAL", font_weight="700")
    + "".join(_rules(f"td.{name}", color=variable(ink)) for name, ink in INKS.items())
    + themed(
        ".rosmini-console", ["ink", "muted", "label", "bad-line", "group-fill", "group-line", "topic-fill"]
    )
)
