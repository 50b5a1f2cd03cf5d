"""The chapter Publish and subscribe: its two tables of results say what its cells found."""

from __future__ import annotations

from .conftest import printed


def test_the_numbers_of_the_prose_are_those_of_the_queues(cells):
    rows = {row.split()[0]: row.split()[1:] for row in printed(cells, 'print("queue picture:age")').splitlines()[1:]}
    ages = {size: [float(entry.partition(":")[2]) for entry in row] for size, row in rows.items()}
    prose = " ".join(cell.source for cell in cells if cell.cell_type == "markdown")
    assert len(ages["None"]) == 10
    assert f"all ten arrive, and the last is {ages['None'][-1]} s old" in prose
    assert len(ages["1"]) == 4
    assert f"four arrive, and none is older than {max(ages['1'])} s" in prose


def test_the_filter_counts_as_the_prose_says(cells):
    assert "careful got 24 messages, calm got 5" in printed(cells, "careful got")
