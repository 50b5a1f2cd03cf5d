"""Chapter 90: other right answers."""

from __future__ import annotations

import pytest

from rosmini.book.checks import Status, find

from .mistakes.chapter_90 import POLYGON, VISIT

CLIMB = "to climb :n :s\nif :n = 0 [stop]\nfd :s rt 90 fd :s lt 90\nclimb :n - 1 :s * 3 / 4\nend"


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
