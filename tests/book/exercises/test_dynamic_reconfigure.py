"""The chapter dynamic_reconfigure: each exercise has a hint, and two are scripts."""

from __future__ import annotations

from book.tools import solutions


def test_two_exercises_are_scripts_and_each_has_a_hint(chapter, prose):
    found = solutions.stubs(chapter)
    assert list(found) == ["camera_cfg", "careful_client", "lights"]
    scripts = [name for name, place in found.items() if chapter.cells[place].source.startswith("%%node ")]
    assert scripts == ["careful_client", "lights"]
    assert prose.count("<summary>Hint</summary>") == len(found)
