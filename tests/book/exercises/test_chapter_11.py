"""Chapter 11, the model of all chapters: its size, its figures, and that its scripts are those of its solutions."""

from __future__ import annotations

import re

from book.tools import notebooks, solutions
from rosmini.book.checks import Script, Status, find

from .conftest import NOTEBOOKS, figure_numbers
from .mistakes.chapter_11 import STOP

CHAPTER = NOTEBOOKS / "11_nodes_and_master.ipynb"
WORDS, CODE_CELLS = 2000, 25


def before_the_exercises():
    """The cells before the exercises; the text before them in a cell that has both."""
    for cell in notebooks.read(CHAPTER).cells:
        text, exercises, _ = cell.source.partition("\n## Exercises\n")
        yield cell.cell_type, text
        if exercises:
            return


def test_it_is_as_short_as_a_chapter_has_to_be():
    cells = list(before_the_exercises())
    prose = re.sub(
        r"```.*?```", "", "\n".join(text for kind, text in cells if kind == "markdown"), flags=re.DOTALL
    )
    assert len(re.findall(r"\S*\w\S*", prose)) <= WORDS
    assert sum(kind == "code" for kind, _ in cells) <= CODE_CELLS


def test_every_figure_is_numbered_in_order_and_mentioned():
    numbers = figure_numbers(CHAPTER.stem)
    assert numbers == list(range(1, len(numbers) + 1))
    prose = "\n".join(text for kind, text in before_the_exercises() if kind == "markdown")
    assert [number for number in numbers if f"Figure 11.{number}" not in prose] == []


def test_every_exercise_is_a_script_with_a_hint():
    notebook = notebooks.read(CHAPTER)
    found = solutions.stubs(notebook)
    assert sorted(found) == ["11.1", "11.2", "11.3", "11.4"]
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    for number, place in found.items():
        assert notebook.cells[place].source.startswith("%%node ")
        assert f"<summary>Hint for exercise {number}</summary>" in text


def test_a_robot_that_creeps_to_the_wall_is_waited_for():
    slow = STOP.replace("0.2", "0.1")
    assert slow != STOP
    assert find("11.1").grade(Script("stop.py", slow)).status is Status.RIGHT
