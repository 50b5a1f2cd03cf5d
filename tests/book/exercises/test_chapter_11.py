"""Chapter 11, the model of all chapters: its exercises are scripts, and other right answers."""

from __future__ import annotations

from book.tools import solutions
from rosmini.book.checks import Script, Status, find

from .mistakes.chapter_11 import STOP


def test_every_exercise_is_a_script_with_a_hint(chapter, prose):
    found = solutions.stubs(chapter)
    assert sorted(found) == ["11.1", "11.2", "11.3", "11.4"]
    for number, place in found.items():
        assert chapter.cells[place].source.startswith("%%node ")
        assert f"<summary>Hint for exercise {number}</summary>" in prose


def test_a_robot_that_creeps_to_the_wall_is_waited_for():
    slow = STOP.replace("0.2", "0.1")
    assert slow != STOP
    assert find("11.1").grade(Script("stop.py", slow)).status is Status.RIGHT
