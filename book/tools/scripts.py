"""The scripts of a notebook: the bodies of its `%%node` cells, with the solutions in the place of stubs."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from book.tools.solutions import solved

if TYPE_CHECKING:
    import nbformat

NODE = re.compile(r"\A%%node +(\S+)[^\n]*\n(.*)\Z", re.DOTALL)


def scripts(notebook: nbformat.NotebookNode) -> dict[str, str]:
    """The scripts by the number of the cell and the name, with the lines where they are in the cell.

    Raises `SolutionError` if a stub has no solution.
    """
    found = (
        (place, NODE.match(cell.source))
        for place, cell in enumerate(solved(notebook).cells, start=1)
        if cell.cell_type == "code"
    )
    return {
        f"cell_{place}_{match[1]}": f"#!/usr/bin/env python3\n{match[2].rstrip()}\n" for place, match in found if match
    }
