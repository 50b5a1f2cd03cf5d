"""The list of exercises on the page "Your progress"."""

from pathlib import Path

from book.tools.progress import exercises

NOTEBOOKS = Path(__file__).resolve().parents[2] / "notebooks"


def test_each_exercise_is_listed_by_the_name_of_its_check():
    assert exercises(NOTEBOOKS / "2_graph" / "10_nodes_and_master.ipynb")["gentle"] == (
        "Exercise 2: A node in the middle"
    )
    found = [exercises(path) for path in sorted(NOTEBOOKS.rglob("*.ipynb"))]
    assert all(found)
    assert len({name for names in found for name in names}) == sum(map(len, found))


def test_a_page_without_a_notebook_has_none():
    assert exercises(NOTEBOOKS.parent / "book" / "ros.md") == {}
