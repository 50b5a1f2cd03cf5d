"""Hidden solutions: found, put in place of the stubs, and refused when a part of an exercise is missing."""

from __future__ import annotations

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from book.tools import solutions
from book.tools.solutions import SolutionError

TEXT = """<details>
<summary>Solution</summary>

```python
names = sorted(["b", "a"])
```

Sorted, since the Master does not.

</details>
"""


def chapter(*, stub="# Exercise: stop\nnames = ...", check='check("stop", names)', solution=TEXT):
    return new_notebook(cells=[new_code_cell(stub), new_code_cell(check), new_markdown_cell(solution)])


def test_the_solution_takes_the_place_of_the_stub():
    nb = chapter()
    solved = solutions.solved(nb)
    assert solved.cells[0].source == '# Exercise: stop\nnames = sorted(["b", "a"])'
    assert solved.cells[1:] == nb.cells[1:]
    assert nb.cells[0].source.endswith("names = ..."), "the notebook itself was changed"


def test_the_line_of_the_magic_stays_with_a_script():
    nb = chapter(stub="%%node names.py _n:=3\n# Exercise: stop\n...", check='check("stop")')
    assert solutions.stubs(nb) == {"stop": 0}
    solved = solutions.solved(nb)
    assert solved.cells[0].source == '%%node names.py _n:=3\n# Exercise: stop\nnames = sorted(["b", "a"])'


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"stub": "names = ..."}, "no stub for the exercise stop"),
        ({"check": "# check"}, "no check for the exercise stop"),
        ({"solution": "none"}, "no solution for the exercise stop"),
        ({"solution": TEXT.replace("```python", "```")}, "the solution to the exercise stop has no ```python block"),
    ],
)
def test_a_part_is_missing(change, message):
    with pytest.raises(SolutionError, match=message):
        solutions.solved(chapter(**change))


def test_what_a_check_printed():
    nb = chapter()
    nb.cells[1].outputs = [new_output("stream", name="stdout", text="Exercise stop: right.\n")]
    assert solutions.check_output(nb, "stop") == "Exercise stop: right.\n"


def test_a_notebook_without_solutions_keeps_hints():
    nb = chapter(solution=f"<details>\n<summary>Hint</summary>\n\nSort.\n\n</details>\n\n{TEXT}\n### Exercise 2: Go")
    text = solutions.without_solutions(nb).cells[2].source
    assert "Solution" not in text
    assert "sorted(" not in text
    assert "Sort." in text
    assert text.endswith("### Exercise 2: Go")
    assert "sorted(" in nb.cells[2].source, "the notebook itself was changed"
