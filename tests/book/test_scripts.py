"""The scripts that a notebook's cells hold."""

from __future__ import annotations

from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.tools.scripts import scripts

SOLUTION = """<details>
<summary>Solution</summary>

```python
x = 2
```

</details>
"""


def test_bodies_of_cells_and_solutions_of_stubs() -> None:
    cells = [
        new_code_cell("%load_ext rosmini"),
        new_code_cell("%%node talker.py _rate:=5\nx = 1"),
        new_markdown_cell("%%node not_code.py\nx"),
        new_code_cell("%%node stop.py\n# Exercise: stop\n..."),
        new_code_cell('check("stop")'),
        new_markdown_cell(SOLUTION),
    ]
    assert scripts(new_notebook(cells=cells)) == {
        "cell_2_talker.py": "#!/usr/bin/env python3\nx = 1\n",
        "cell_4_stop.py": "#!/usr/bin/env python3\n# Exercise: stop\nx = 2\n",
    }
