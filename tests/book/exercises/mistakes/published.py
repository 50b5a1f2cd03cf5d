"""The solutions that the chapters show: most wrong answers are one of them with a fault put in."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from book.tools import notebooks, solutions

NOTEBOOKS = Path(__file__).resolve().parents[4] / "notebooks"


@cache
def _solutions(chapter: str) -> dict[str, str]:
    [path] = NOTEBOOKS.glob(f"*/[0-9][0-9]_{chapter}.ipynb")
    return solutions.solutions(notebooks.read(path))


def solution(chapter: str, exercise: str) -> str:
    """Return the code of a solution."""
    return f"\n{_solutions(chapter)[exercise]}\n"
