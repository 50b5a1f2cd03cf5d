"""Each chapter comes out the same on each run, and on another machine.

Its stored outputs are of one run, and nbval compares a second one. This is a third, on the plainest machine: a kernel
that orders sets and hashes strings differently, has no vector units beyond the least that numpy needs (its functions
differ in the last bit between them), and casts the laser's rays in numpy instead of numba. The bytes of pictures, which
nbval does not compare, are the same, too.
"""

from __future__ import annotations

import copy
import os
from pathlib import Path
from typing import Any

import pytest

from book.tools import notebooks

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").glob("*.ipynb"))
DEAR = (
    ()
    if os.environ.get("ROSMINI_TEST_MACHINE") == "all"
    else ("23_gazebo", "40_turtlebot3", "73_many_turtlebots")
)
"""Each takes half a minute to two, where rays are cast in numpy: on request only, since CI has half an hour for all."""


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
def test_a_chapter_gives_its_stored_outputs_on_another_machine(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if path.stem in DEAR:
        pytest.skip("dear: ROSMINI_TEST_MACHINE=all runs it")
    stored = notebooks.read(path)
    for name, value in {"PYTHONHASHSEED": "2", **plain_machine()}.items():
        monkeypatch.setenv(name, value)
    notebook = copy.deepcopy(stored)
    notebooks.execute(notebook, path.parent)
    notebooks.clean(notebook)
    assert outputs(notebook) == outputs(stored)
