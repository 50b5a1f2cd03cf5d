"""The time that a chapter takes, and the cell that a downloaded notebook begins with."""

from __future__ import annotations

from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.tools import reading


def test_the_time_counts_words_cells_and_exercises_up_to_the_exercises():
    text = "word " * 300 + "\n```console\n" + "code " * 900 + "\n```\n"
    stub = new_code_cell("%%node a.py\n# Exercise: a\n...")
    cells = [
        new_markdown_cell(text),
        new_code_cell("1"),
        new_code_cell("2"),
        new_markdown_cell("\n## Exercises\n"),
        stub,
    ]
    notebook = new_notebook(cells=cells)
    assert reading.minutes(notebook) == 15  # 2 + 2 + 10, rounded up to five
    cells[0].source = "Allow 90 minutes, exercises included. " + text
    reading.state_minutes(notebook)
    assert cells[0].source.startswith("Allow 15 minutes, exercises")


def test_directions_come_first_and_once():
    notebook = new_notebook(cells=[new_markdown_cell("# 7. Title")])
    for _ in range(2):
        reading.add_directions(notebook, "07_title.ipynb", "https://example.org/book")
    first, second = notebook.cells
    assert "git clone https://example.org/book" in first.source
    assert second.source == "# 7. Title"
