"""The chapter Logo: other right answers."""

from __future__ import annotations

import pytest

from rosmini.book.checks import Status, find

from .mistakes.logo import POLYGON, VISIT

CLIMB = "to climb :n :s\nif :n = 0 [stop]\nfd :s rt 90 fd :s lt 90\nclimb :n - 1 :s * 3 / 4\nend"


@pytest.mark.parametrize(
    ("number", "program"),
    [
        ("polygon", f"%%logo\n{POLYGON}"),
        ("polygon", "TO POLYGON :n :s\nREPEAT :n [LT 360/:n FD :s]\nEND\npolygon 4 100"),
        ("stairs", f"{CLIMB}\nto stairs :a :b\nclimb :a :b\nend"),
        ("visit", f"; without setpos\n{VISIT}"),
    ],
)
def test_other_programs_are_right(number, program):
    assert find(number).grade(program).status is Status.RIGHT
