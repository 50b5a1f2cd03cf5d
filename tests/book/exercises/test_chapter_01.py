"""The first steps: short enough for twenty minutes, and in ROS's own commands."""

from __future__ import annotations

import re

from book.tools import notebooks, solutions
from rosmini.book.checks import Script, Status, find

from .conftest import NOTEBOOKS
from .mistakes.chapter_01 import STOP

CHAPTER = NOTEBOOKS / "01_first_steps.ipynb"
WORDS, CODE_CELLS = 700, 12


def test_it_is_short():
    cells = notebooks.read(CHAPTER).cells
    prose = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    prose = re.sub(r"^```.*?^```", "", prose, flags=re.DOTALL | re.MULTILINE)
    assert len(re.findall(r"\S*\w\S*", prose)) <= WORDS
    assert sum(cell.cell_type == "code" for cell in cells) <= CODE_CELLS


def test_it_teaches_neither_the_master_nor_an_interface_of_our_own():
    text = "\n".join(cell.source for cell in notebooks.read(CHAPTER).cells)
    for word in ("XML-RPC", "md5", "Graph(", "default_graph", ".program", ".instance()"):
        assert word not in text


def test_its_one_exercise_has_an_answer():
    assert list(solutions.stubs(notebooks.read(CHAPTER))) == ["1.1"]
    assert find("1.1").grade(Script("stop.py", STOP)).status is Status.RIGHT
