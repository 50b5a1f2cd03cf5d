"""Each chapter comes out the same on each run: twice, in fresh kernels that order sets and hash strings differently."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest

from rosmini.book import notebooks

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def outputs(notebook: Any) -> list[tuple[str, Any]]:
    """Every output of every cell, pictures' bytes included, which nbval does not compare."""
    return [(cell.source, cell.outputs) for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_chapters() -> None:
    assert CHAPTERS


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_a_chapter_run_twice_gives_its_stored_outputs_twice(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stored = notebooks.read(path)
    runs = []
    for seed in ("1", "2"):
        monkeypatch.setenv("PYTHONHASHSEED", seed)
        notebook = copy.deepcopy(stored)
        notebooks.execute(notebook, path.parent)
        notebooks.clean(notebook)
        runs.append(outputs(notebook))
    assert runs[0] == runs[1]
    assert runs[0] == outputs(stored)
