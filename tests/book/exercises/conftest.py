"""Chapters as the tests read them."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from book.tools import notebooks, reading

from ...processes import run

NOTEBOOKS = Path(__file__).resolve().parents[3] / "notebooks"


def prose_of(chapter: str) -> str:
    """The text cells of a chapter."""
    cells = notebooks.read(NOTEBOOKS / f"{chapter}.ipynb").cells
    return "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


def printed(cells: Any, start: str) -> str:
    """What the cell with this text in it has printed."""
    [cell] = [cell for cell in cells if cell.cell_type == "code" and start in cell.source]
    return "".join(output.get("text", "") for output in cell.outputs)


def assert_short(cells: Any) -> None:
    """A chapter has at most 2,300 words and 25 code cells before its exercises (DESIGN, section 7)."""
    found, code_cells = reading.length(SimpleNamespace(cells=cells))
    assert found <= 2300
    assert code_cells <= 25


def figure_numbers(chapter: str) -> list[int]:
    """The numbers of a chapter's figures, in the order of its cells."""
    cells = notebooks.read(NOTEBOOKS / f"{chapter}.ipynb").cells
    code = [cell.source for cell in cells if cell.cell_type == "code"]
    title = re.compile(rf"Figure {chapter[:2]}\.(\d+): ")
    return [int(number) for source in code for number in title.findall(source)]


def assert_figures_are_numbered(chapter: str, makers: tuple[str, ...]) -> None:
    """The figures of a chapter are numbered 1, 2, 3...; there are as many as calls of their `makers` in its cells."""
    cells = notebooks.read(NOTEBOOKS / f"{chapter}.ipynb").cells
    calls = sum(cell.source.count(word) for cell in cells if cell.cell_type == "code" for word in makers)
    numbers = figure_numbers(chapter)
    assert numbers == list(range(1, len(numbers) + 1))
    assert calls == len(numbers) > 0


def write_scripts(prose: str, folder: Path) -> set[str]:
    """Write the scripts that a page lists to a folder; their names."""
    scripts = dict(re.findall(r"^`(\w+\.py)`:\n\n```python\n(.*?)^```", prose, re.DOTALL | re.MULTILINE))
    for name, text in scripts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return set(scripts)


def run_rosmini(command: str, folder: Path) -> tuple[int, str, str]:
    """Run `rosmini` with these words; its exit status and what it printed."""
    done = run([sys.executable, "-m", "rosmini", *shlex.split(command)], cwd=folder)
    return done.returncode, done.stdout, done.stderr


def assert_scripts_print_what_is_shown(prose: str, folder: Path, names: set[str]) -> None:
    """Run the scripts that a page lists by the command that it shows; they print what stands below it."""
    assert write_scripts(prose, folder) == names
    shown = re.search(r"^```console\n\$ uv run rosmini (run .*?)\n(.*?)^```", prose, re.DOTALL | re.MULTILINE)
    assert shown is not None
    assert run_rosmini(shown[1], folder) == (0, shown[2], "")
