"""Chapters as the tests read them."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from book.tools import notebooks
from book.tools.captions import CAPTION

NOTEBOOKS = Path(__file__).resolve().parents[3] / "notebooks"


@pytest.fixture(scope="module")
def chapter(request):
    """The notebook of the chapter that the module tests."""
    name = request.module.__name__.rpartition(".test_")[2]
    [path] = NOTEBOOKS.glob(f"*/[0-9][0-9]_{name}.ipynb")
    return notebooks.read(path)


@pytest.fixture(scope="module")
def cells(chapter):
    return chapter.cells


@pytest.fixture(scope="module")
def code(cells):
    """The sources of its code cells."""
    return [cell.source for cell in cells if cell.cell_type == "code"]


@pytest.fixture(scope="module")
def figures(cells):
    """The text forms of its figures, by their numbers."""
    found = {}
    for cell, below in pairwise(cells):
        caption = CAPTION.match(below.source)
        texts = [output.data["text/plain"] for output in cell.get("outputs", ()) if "data" in output]
        if caption and caption["kind"] == "Figure" and texts:
            found[len(found) + 1] = texts[-1]
    return found


@pytest.fixture(scope="module")
def prose(cells):
    """Its text cells, joined."""
    return "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


def printed(cells: Any, start: str) -> str:
    """What the cell with this text in it has printed."""
    [cell] = [cell for cell in cells if cell.cell_type == "code" and start in cell.source]
    return "".join(output.get("text", "") for output in cell.outputs)


def all_printed(cells: Any) -> str:
    """What all cells have printed."""
    return "".join(output.get("text", "") for cell in cells for output in cell.get("outputs", ()))
