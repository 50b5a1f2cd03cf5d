"""`rosmini assignment`: a notebook with chosen exercises, which can be worked on and graded."""

from __future__ import annotations

from pathlib import Path

import pytest

from book.tools import notebooks
from book.tools.assignment import AssignmentError, assignment
from book.tools.solutions import checks, stubs
from rosmini.book import grade, submission
from rosmini.tools import main

CHAPTERS = Path(__file__).resolve().parents[2] / "notebooks"


def test_it_has_the_chosen_exercises_their_seed_and_no_solutions():
    made = assignment(CHAPTERS, ["trip", "stop"], 5)
    assert list(stubs(made)) == list(checks(made)) == ["trip", "stop"]
    text = "\n".join(cell.source for cell in made.cells)
    assert text.index("### Exercise 1: A trip meter") < text.index("### Exercise 2: Stop before the wall")
    assert 'check("stop", seed=5)' in text
    assert "Solution" not in text
    assert not any(cell.outputs for cell in made.cells if cell.cell_type == "code")


def test_it_is_written_once_and_found_by_the_grader(tmp_path, capsys):
    words = ["assignment", str(tmp_path / "week" / "ada.ipynb"), "--exercises", "stop"]
    assert main.main(words) == 0
    assert main.main(words) == 1
    assert AssignmentError.__name__ not in capsys.readouterr().err
    [student] = grade.found_in(tmp_path / "week")
    assert submission.exercises_in(submission.cells(student.notebooks[0])) == ["stop"]
    assert notebooks.read(student.notebooks[0]).cells


@pytest.mark.parametrize("names", ["stopp", ""])
def test_an_unknown_exercise_is_an_error(tmp_path, capsys, names):
    assert main.main(["assignment", str(tmp_path / "a.ipynb"), "--exercises", names]) == 1
    assert "no exercise" in capsys.readouterr().err
