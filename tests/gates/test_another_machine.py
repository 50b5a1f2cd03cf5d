"""Each chapter comes out the same on each run and on another machine, and then its solutions pass their checks.

Its stored outputs are of one run, and nbval compares a second one. This is a third, on the plainest machine: a kernel
that orders sets and hashes strings differently, and casts the laser's rays in numpy instead of numba. It uses no vector
units beyond the least that numpy needs, no fused multiplication and addition in the C library, BLAS's routines for the
oldest processor, and machine code of numba's for any processor: all of these differ in the last bit. The bytes of
pictures, which nbval does not compare, are the same, too.

Then it goes on as a reader does, in the same kernel: all that follows the first stub runs again, with the solutions.
"""

from __future__ import annotations

import copy
import os
import platform
from pathlib import Path
from typing import Any

import pytest

from book.tools import notebooks, solutions

from ..conftest import nightly

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").rglob("*.ipynb"))
EACH_COMMIT = {"10_nodes_and_master"}
"""The other chapters run at night. So does this module for a chapter that somebody names: `pytest FILE -k 60_amcl`."""

IS_X86 = platform.machine().lower() in ("x86_64", "amd64")
PLAIN_X86 = {
    "OPENBLAS_CORETYPE": "Prescott",
    "NUMBA_CPU_NAME": "generic",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  # "-FMA_Usable" before glibc 2.33
}
"""What makes OpenBLAS, numba and glibc take the oldest of their variants."""


def outputs(notebook: Any) -> list[tuple[str, Any]]:
    """Every output of every cell, pictures' bytes included, which nbval does not compare."""
    return [(cell.source, cell.outputs) for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_chapters() -> None:
    assert CHAPTERS


def plain_machine() -> dict[str, str]:
    """The environment of a kernel on the plainest machine. What the machine sets itself stays as it is."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    features = [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]
    plain = {"NPY_DISABLE_CPU_FEATURES": " ".join(features), **(PLAIN_X86 if IS_X86 else {})}
    given = {name: plain[name] for name in plain if name not in os.environ}
    return {"PYTHONHASHSEED": "2", "ROSMINI_RAYCAST": "numpy", **given}


@pytest.fixture(
    scope="module",
    params=[
        *(path for path in CHAPTERS if path.stem in EACH_COMMIT),
        *nightly(*(path for path in CHAPTERS if path.stem not in EACH_COMMIT)),
    ],
    ids=lambda path: path.stem,
)
def chapter(request: pytest.FixtureRequest) -> tuple[Any, Any, Any]:
    """A chapter as stored, as it comes out, and its exercises with their solutions, which ran after it."""
    path: Path = request.param
    stored = notebooks.read(path)
    run, solved = copy.deepcopy(stored), solutions.solved(stored)
    answers = solved.cells[min(solutions.stubs(solved).values()) :]
    run.cells += [cell for cell in answers if cell.cell_type == "code"]
    with pytest.MonkeyPatch.context() as patch:
        for name, value in plain_machine().items():
            patch.setenv(name, value)
        notebooks.execute(run, path.parent)
    notebooks.clean(run)
    again = copy.deepcopy(run)
    again.cells = run.cells[len(stored.cells) :]
    del run.cells[len(stored.cells) :]
    return stored, run, again


def test_a_chapter_gives_its_stored_outputs_on_another_machine(chapter: tuple[Any, Any, Any]) -> None:
    stored, run, _ = chapter
    assert outputs(run) == outputs(stored)


def test_the_hidden_solutions_pass_their_checks(chapter: tuple[Any, Any, Any]) -> None:
    stored, _, again = chapter
    for number in solutions.stubs(stored):
        assert solutions.check_output(again, number).startswith(f"Exercise {number}: right.")
