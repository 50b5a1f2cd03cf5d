"""Published solutions with other errors of the sensors."""

from __future__ import annotations

from pathlib import Path

import pytest

from book.tools import notebooks, solutions
from rosmini.book import checks

NOTEBOOKS = Path(__file__).resolve().parents[3] / "notebooks"


@pytest.mark.parametrize(
    ("chapter", "name"), [("2_graph/20_topics_and_messages", "face"), ("7_navigation/50_local_planners", "wander")]
)
def test_a_solution_is_right_whatever_the_errors_of_the_laser(chapter, name):
    notebook = notebooks.read(NOTEBOOKS / f"{chapter}.ipynb")
    script = solutions.solved(notebook).cells[solutions.stubs(notebook)[name]].source
    verdict = checks.find(name).grade(checks.Script(f"{name}.py", script.partition("\n")[2]), seed=101)
    assert verdict, verdict.text
