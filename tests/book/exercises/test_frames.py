"""The chapter Frames: its cells print the errors that the text promises, and the exercises are scripts."""

from __future__ import annotations

from book.tools import solutions

from .conftest import all_printed, printed


def test_the_errors_of_tf_are_printed(cells):
    said = all_printed(cells)
    for name in ("LookupException", "ConnectivityException", "ExtrapolationException", "TF_REPEATED_DATA"):
        assert name in said


def test_a_timeout_answers_the_question_about_the_future(cells):
    lines = printed(cells, "rosmini.wait(0.01)").splitlines()
    assert "into the future" in lines[-4]
    assert lines[-1].startswith("x = ")


def test_every_exercise_is_a_script_with_a_hint(chapter, prose):
    found = solutions.stubs(chapter)
    assert list(found) == ["carrot", "upside_down", "localise"]
    assert all(chapter.cells[place].source.startswith("%%node ") for place in found.values())
    assert prose.count("<summary>Hint</summary>") == len(found)
