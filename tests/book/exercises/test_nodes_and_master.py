"""The chapter Nodes and the Master: its exercises are scripts, and other right answers."""

from __future__ import annotations

from book.tools import solutions
from rosmini.book.checks import Script, Status, find

from .mistakes.nodes_and_master import STOP


def test_every_exercise_is_a_script_with_a_hint(chapter, prose):
    found = solutions.stubs(chapter)
    assert list(found) == ["stop", "gentle", "introduce", "referee"]
    assert all(chapter.cells[place].source.startswith("%%node ") for place in found.values())
    assert prose.count("<summary>Hint</summary>") == len(found)


def test_a_robot_that_creeps_to_the_wall_is_waited_for():
    slow = STOP.replace("0.2", "0.1")
    assert slow != STOP
    assert find("stop").grade(Script("stop.py", slow)).status is Status.RIGHT
