"""Chapter 90: its size, its figures, and other right answers."""

from __future__ import annotations

import pytest

from book.tools import notebooks
from rosmini.book.checks import Status, find

from .conftest import NOTEBOOKS, assert_short, figure_numbers
from .mistakes.chapter_90 import POLYGON, VISIT

CLIMB = "to climb :n :s\nif :n = 0 [stop]\nfd :s rt 90 fd :s lt 90\nclimb :n - 1 :s * 3 / 4\nend"


def test_it_is_as_short_as_a_chapter_has_to_be():
    assert_short(notebooks.read(NOTEBOOKS / "90_logo.ipynb").cells)


def test_its_figures_are_numbered():
    assert figure_numbers("90_logo") == list(range(1, 9))


@pytest.mark.parametrize(
    ("number", "program"),
    [
        ("90.1", f"%%logo\n{POLYGON}"),
        ("90.1", "TO POLYGON :n :s\nREPEAT :n [LT 360/:n FD :s]\nEND\npolygon 4 100"),
        ("90.2", f"{CLIMB}\nto stairs :a :b\nclimb :a :b\nend"),
        ("90.3", f"; without setpos\n{VISIT}"),
    ],
)
def test_other_programs_are_right(number, program):
    assert find(number).grade(program).status is Status.RIGHT
