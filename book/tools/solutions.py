"""The hidden solutions of a notebook's exercises, and the notebook with them in place of the stubs.

A stub is a code cell whose first line is `# Exercise: NAME`, or a script: a cell whose first line is `%%node NAME.py`,
and whose second one is that. Its solution is the first Python block after the next `<summary>Solution</summary>` of a
Markdown cell; the line of the magic stays.
"""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING

from rosmini.core.errors import RosminiError

if TYPE_CHECKING:
    import nbformat

STUB = re.compile(r"\A(%%node [^\n]*\n|)#\s*Exercise:\s+(\w+)\b")
FOLD = re.compile(r"<details>\s*<summary>Solution</summary>.*?</details>\s*", re.DOTALL)
SOLUTION = re.compile(r"<summary>Solution</summary>(.*?)</details>", re.DOTALL)
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
CHECK = re.compile(r"^check\(\s*[\"'](\w+)[\"']", re.MULTILINE)


class SolutionError(RosminiError):
    """Stubs, checks and solutions of a notebook do not belong together."""


def stubs(notebook: nbformat.NotebookNode) -> dict[str, int]:
    """The places of the stub cells (from 0), by the name of the exercise."""
    found = ((STUB.match(cell.source), place) for place, cell in enumerate(notebook.cells) if cell.cell_type == "code")
    return {match[2]: place for match, place in found if match}


def checks(notebook: nbformat.NotebookNode) -> dict[str, int]:
    """The places of the cells that call `check` (from 0), by the name of the exercise."""
    cells = ((place, cell.source) for place, cell in enumerate(notebook.cells) if cell.cell_type == "code")
    return {name: place for place, source in cells for name in CHECK.findall(source)}


def solutions(notebook: nbformat.NotebookNode) -> dict[str, str]:
    """The code of the solutions, by the name of the exercise. Raises `SolutionError` if one has no Python block."""
    found: dict[str, str] = {}
    name = ""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            stub, check = STUB.match(cell.source), CHECK.search(cell.source)
            name = stub[2] if stub else check[1] if check else name
            continue
        for text in SOLUTION.findall(cell.source):
            block = PYTHON.search(text)
            if not block:
                raise SolutionError(f"the solution to the exercise {name} has no ```python block")
            found[name] = block[1].rstrip()
    return found


def solved(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """A copy of `notebook` with each stub replaced by its solution.

    Raises `SolutionError` unless each exercise has a stub, a check and a solution.
    """
    at, checked, code = stubs(notebook), checks(notebook), solutions(notebook)
    for what, names in (("stub", at), ("check", checked), ("solution", code)):
        missing = sorted((at.keys() | checked.keys() | code.keys()) - names.keys())
        if missing:
            raise SolutionError(f"no {what} for the exercise {', '.join(missing)}")
    copied = copy.deepcopy(notebook)
    for name, place in at.items():
        cell = copied.cells[place]
        ((magic, _),) = STUB.findall(cell.source)
        cell.source = f"{magic}# Exercise: {name}\n{code[name]}"
    return copied


def without_solutions(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """A copy of `notebook` without the solutions of its exercises."""
    copied = copy.deepcopy(notebook)
    for cell in copied.cells:
        if cell.cell_type == "markdown":
            cell.source = FOLD.sub("", cell.source).rstrip("\n")
    return copied


def check_output(notebook: nbformat.NotebookNode, name: str) -> str:
    """What the check of the exercise `name` printed."""
    outputs = notebook.cells[checks(notebook)[name]].outputs
    return "".join(output.get("text", "") for output in outputs)
