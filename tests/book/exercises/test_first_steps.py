"""The first steps: short enough for twenty minutes, and in ROS's own commands."""

from __future__ import annotations

import re

from book.tools import solutions
from book.tools.captions import CAPTION
from rosmini.book.checks import Script, Status, find

from .mistakes.first_steps import STOP

WORDS, CODE_CELLS = 700, 12


def test_it_is_short(cells, prose):
    prose = CAPTION.sub("", re.sub(r"^```.*?^```", "", prose, flags=re.DOTALL | re.MULTILINE))
    assert len(re.findall(r"\S*\w\S*", prose)) <= WORDS
    assert sum(cell.cell_type == "code" for cell in cells) <= CODE_CELLS


def test_it_teaches_neither_the_master_nor_an_interface_of_our_own(cells):
    text = "\n".join(cell.source for cell in cells)
    for word in ("XML-RPC", "md5", "Graph(", "default_graph", ".program", ".instance()"):
        assert word not in text


def test_its_one_exercise_has_an_answer(chapter):
    assert list(solutions.stubs(chapter)) == ["first_stop"]
    assert find("first_stop").grade(Script("stop.py", STOP)).status is Status.RIGHT
