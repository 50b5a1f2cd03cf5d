"""The page that maps the report's parts to ours has all of them, and the figures that it names exist."""

from __future__ import annotations

import re

from book.tools import notebooks

from .exercises.conftest import NOTEBOOKS

BOOK = NOTEBOOKS.parent / "book"
PAGE = (BOOK / "about" / "report.md").read_text(encoding="utf-8")

FIGURES = {2: 2, 3: 11, 4: 9, 5: 10, 6: 2, 7: 1, 8: 7, 9: 13, 10: 8}
LISTINGS = {3: 8, 7: 1, 8: 3, 9: 2}
"""How many the report has, by chapter."""
SECTIONS = {1: 4, 2: 4, 3: 6, 4: 5, 5: 9, 6: 4, 7: 7, 8: 2, 9: 6, 10: 2}


def numbers(heading: str) -> list[str]:
    """The first column of the table under a heading."""
    part = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    return re.findall(r"^\| (\d[\d.]*) \|", part, re.MULTILINE)


def counted(counts: dict[int, int]) -> list[str]:
    return [f"{chapter}.{i}" for chapter, count in counts.items() for i in range(1, count + 1)]


def test_every_figure_and_listing_of_the_report_has_a_row():
    assert numbers("Figures and tables") == counted(FIGURES)
    assert numbers("Listings") == counted(LISTINGS)


def test_every_section_of_the_report_has_a_row():
    found = numbers("Sections")
    assert [number for number in found if number.count(".") == 1] == counted(SECTIONS)
    assert len(found) == len(set(found))


def test_every_row_leads_to_a_page_or_gives_a_reason():
    rows = [line for line in PAGE.splitlines() if re.match(r"\| (\d|App)", line)]
    assert rows
    assert [row for row in rows if "{doc}" not in row and "left out, because" not in row] == []


def test_the_figures_and_tables_that_it_names_are_there():
    named = re.findall(r"\[((?:Figure|Table) \d+)\]\(([^)#]+)#([^)]+)\)", PAGE)
    assert named
    for name, file, label in named:
        path = BOOK / "about" / file
        prose = notebooks.prose(notebooks.read(path)) if path.suffix == ".ipynb" else [path.read_text(encoding="utf-8")]
        assert f'<a id="{label}"></a>{name}: ' in "\n".join(prose)
