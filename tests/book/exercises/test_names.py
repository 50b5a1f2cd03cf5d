"""The chapter Names: names resolve as its text says, and the check of an exercise starts the chapter's program."""

from __future__ import annotations

from rosmini.book.exercises.names import PATROL

from .conftest import printed


def test_both_sides_of_a_remapping_are_resolved_once(cells):
    amy = printed(cells, "%rosrun notebook names.py __ns:=/amy scan:=/front_laser")
    assert "/scan     is /scan" in amy
    assert " scan      is /front_laser" in amy
    chain = printed(cells, "%rosrun notebook names.py scan:=map map:=plan")
    assert " scan      is /map" in chain
    assert "map       is /plan" in chain


def test_the_exercise_starts_the_same_program(code):
    chapter = next(source for source in code if source.startswith("%%node patrol.py"))
    for line in PATROL.strip().splitlines():
        assert line in chapter
