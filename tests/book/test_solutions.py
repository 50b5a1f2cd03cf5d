"""Hidden solutions: found, put in place of the stubs, and refused when a part of an exercise is missing."""

from __future__ import annotations

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from book.tools import solutions
from book.tools.solutions import SolutionError

TEXT = """<details>
<summary>Solution to exercise 11.1</summary>

```python
names = sorted(["b", "a"])
```

Sorted, since the Master does not.

</details>
"""


def chapter(*, stub="# Exercise 11.1: names\nnames = ...", check='check("11.1", names)', solution=TEXT):
    return new_notebook(cells=[new_code_cell(stub), new_code_cell(check), new_markdown_cell(solution)])


def test_the_solution_takes_the_place_of_the_stub():
    nb = chapter()
    solved = solutions.solved(nb)
    assert solved.cells[0].source == '# Exercise 11.1\nnames = sorted(["b", "a"])'
    assert solved.cells[1:] == nb.cells[1:]
    assert nb.cells[0].source.endswith("names = ..."), "the notebook itself was changed"


def test_the_line_of_the_magic_stays_with_a_script():
    nb = chapter(stub="%%node names.py _n:=3\n# Exercise 11.1\n...", check='check("11.1")')
    assert solutions.stubs(nb) == {"11.1": 0}
    solved = solutions.solved(nb)
    assert solved.cells[0].source == '%%node names.py _n:=3\n# Exercise 11.1\nnames = sorted(["b", "a"])'


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"stub": "names = ..."}, "no stub for exercise 11.1"),
        ({"check": "# check"}, "no check for exercise 11.1"),
        ({"solution": "none"}, "no solution for exercise 11.1"),
        (
            {"solution": TEXT.replace("```python", "```")},
            "the solution to exercise 11.1 has no ```python block",
        ),
    ],
)
def test_a_part_is_missing(change, message):
    with pytest.raises(SolutionError, match=message):
        solutions.solved(chapter(**change))


def test_what_a_check_printed():
    nb = chapter()
    nb.cells[1].outputs = [new_output("stream", name="stdout", text="Exercise 11.1: right.\n")]
    assert solutions.check_output(nb, "11.1") == "Exercise 11.1: right.\n"
