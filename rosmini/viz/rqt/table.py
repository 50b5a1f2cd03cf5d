"""A table of a tool of rqt as a still: text, and a figure with the table that the panel shows."""

from __future__ import annotations

from rosmini.viz.svg import element, escape
from rosmini.viz.view import View
from rosmini.viz.words import plural

from .markup import TABLE_CSS, table
from .parts import Rows, aligned, cell_text

ALT_ROWS = 3
"""Number of rows that the alt text contains."""


class Table(View):
    """The rows of a panel, under a title.

    Args:
        part: columns and rows; a row with a depth belongs to the one above.
        title: first words of the text and the caption.
        noun: noun for the number of rows.

    """

    def __init__(self, part: Rows, *, title: str, noun: str) -> None:
        self.part = part
        self.title = title
        self._noun = noun

    def __len__(self) -> int:
        return len(self.part.rows)

    @property
    def counted(self) -> str:
        """The number of rows, without those that belong to another."""
        return plural(sum(not row.depth for row in self.part.rows), self._noun)

    @property
    def caption(self) -> str:
        """Title and count."""
        return f"{self.title} ({self.counted})"

    @property
    def text(self) -> str:
        """A line with the count, the titles of the columns, and a line for each row."""
        lines = aligned(self.part) if self.part.rows else []
        return "\n".join([f"{self.title}: {self.counted}", *(f"  {line}" for line in lines)])

    @property
    def alt(self) -> str:
        """Count, columns and the first rows."""
        rows = (filter(None, map(cell_text, row.cells)) for row in self.part.rows[:ALT_ROWS])
        first = "; ".join(", ".join(row) for row in rows)
        columns = ", ".join(self.part.columns)
        return f"Table of {self.title}, {self.counted}; columns {columns}. {first}".strip()

    def _images(self) -> dict[str, bytes]:
        return {}

    @property
    def html(self) -> str:
        """A `<figure>` with the table, which scrolls in a narrow page."""
        return element(
            "figure",
            f"<style>{TABLE_CSS}</style>{table(self.part)}{element('figcaption', escape(self.caption))}",
            class_="rosmini-figure",
            style="margin:0.5em 0",
        )
