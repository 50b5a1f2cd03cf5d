"""Chapter 93: its figures are numbered, and its two tables of results say what its cells found."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from book.tools import notebooks

from .conftest import figure_numbers

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "93_publish_subscribe.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def printed(cells, word):
    """What the one cell prints whose source has this word."""
    (cell,) = [cell for cell in cells if cell.cell_type == "code" and word in cell.source]
    return "".join(output.text for output in cell.outputs if output.output_type == "stream")


def test_every_figure_is_numbered_in_order(cells):
    code = [cell.source for cell in cells if cell.cell_type == "code"]
    numbers = figure_numbers(CHAPTER.stem)
    assert numbers == list(range(1, len(numbers) + 1))
    assert sum(len(re.findall(r"\b(?:rqt_graph|plot)\(", source)) for source in code) == len(numbers) > 0


def test_the_numbers_of_the_prose_are_those_of_the_queues(cells):
    rows = {
        row.split()[0]: row.split()[1:]
        for row in printed(cells, 'print("queue picture:age")').splitlines()[1:]
    }
    ages = {size: [float(entry.partition(":")[2]) for entry in row] for size, row in rows.items()}
    prose = " ".join(cell.source for cell in cells if cell.cell_type == "markdown")
    assert len(ages["None"]) == 10
    assert f"all ten arrive, and the last is {ages['None'][-1]} s old" in prose
    assert len(ages["1"]) == 4
    assert f"four arrive, and none is older than {max(ages['1'])} s" in prose


def test_the_filter_counts_as_the_prose_says(cells):
    assert "careful got 24 messages, calm got 5" in printed(cells, "careful got")
