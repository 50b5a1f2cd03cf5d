"""The chapter Services: its exercises are scripts with hints."""

from __future__ import annotations

from book.tools import solutions


def test_every_exercise_is_a_script_with_a_hint(chapter, prose):
    found = solutions.stubs(chapter)
    assert list(found) == ["trip", "ask_first", "is_free"]
    assert all(chapter.cells[place].source.startswith("%%node ") for place in found.values())
    assert prose.count("<summary>Hint</summary>") == len(found)
