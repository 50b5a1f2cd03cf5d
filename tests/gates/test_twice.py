"""Each chapter comes out the same on each run, and on another machine.

It runs twice, in fresh kernels that order sets and hash strings differently. The second has no vector units beyond the
least that numpy needs (its functions differ in the last bit between them) and casts the laser's rays in numpy instead
of numba.
"""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest

from book.tools import notebooks

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def outputs(notebook: Any) -> list[tuple[str, Any]]:
    """Every output of every cell, pictures' bytes included, which nbval does not compare."""
    return [(cell.source, cell.outputs) for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_chapters() -> None:
    assert CHAPTERS


def plain_machine() -> dict[str, str]:
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    features = [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]
    return {"NPY_DISABLE_CPU_FEATURES": " ".join(features), "ROSMINI_RAYCAST": "numpy"}


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_a_chapter_run_twice_gives_its_stored_outputs_twice(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stored = notebooks.read(path)
    runs = []
    for environment in ({"PYTHONHASHSEED": "1"}, {"PYTHONHASHSEED": "2", **plain_machine()}):
        for name, value in environment.items():
            monkeypatch.setenv(name, value)
        notebook = copy.deepcopy(stored)
        notebooks.execute(notebook, path.parent)
        notebooks.clean(notebook)
        runs.append(outputs(notebook))
    assert runs[0] == runs[1]
    assert runs[0] == outputs(stored)
