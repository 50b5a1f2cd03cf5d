"""Every notebook as stored, and the comparison itself: a tampered notebook turns the run red."""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import nbformat
import pytest

from book.tools import notebooks, solutions
from rosmini.book.checks import Script, find

from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
CHAPTERS = sorted((ROOT / "notebooks").rglob("*.ipynb"))

QUICKEST = "9_deeper/20_publish_subscribe.ipynb"

chapters = pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)


@chapters
def test_the_stored_form_is_clean(chapter):
    assert list(notebooks.problems(notebooks.read(chapter))) == []


@chapters
def test_a_chapter_has_three_exercises_at_least(chapter):
    notebook = notebooks.read(chapter)
    stubs = solutions.stubs(notebook)
    assert len(stubs) >= (1 if chapter.stem == "10_first_steps" else 3)
    for name, place in stubs.items():
        magic, _, source = notebook.cells[place].source.partition("\n")
        answer = Script("stub.py", f"\n{source}") if magic.startswith("%%node ") else ...
        assert solutions.check_output(notebook, name) == f"{find(name).grade(answer)}\n"


NUMBER = re.compile(r"\b[Cc]hapters? \[?\d|\b(?:[Ff]igure|[Tt]able|[Ee]xercise)s? \d+\.\d")


@chapters
def test_a_chapter_contains_no_number_of_a_chapter(chapter):
    sources = [cell.source for cell in notebooks.read(chapter).cells]
    assert re.match(r"# \D", sources[0])
    assert [found[0] for source in sources for found in NUMBER.finditer(source)] == []


@chapters
def test_the_checks_know_how_many_gaps_a_script_has(chapter):
    notebook = notebooks.read(chapter)
    for name, place in solutions.stubs(notebook).items():
        source = notebook.cells[place].source
        if source.startswith("%%node "):
            script = Script("stub.py", source.partition("\n")[2])
            assert (name, find(name).gaps) == (name, len(script.gaps))


def make_three_outputs_differ(notebook) -> None:
    """One is changed, one removed, and a cell prints something else than is stored."""
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    changed, removed, *_ = (cell for cell in code if cell.get("outputs"))
    changed.outputs.append(nbformat.v4.new_output("stream", name="stdout", text="tampered\n"))
    removed.outputs = []
    code[-1].source += "\nprint('something else')"


def forget_an_execution(notebook) -> None:
    cell = next(cell for cell in notebook.cells if cell.cell_type == "code")
    cell.execution_count = None


def empty_a_cell(notebook) -> None:
    cell = next(cell for cell in notebook.cells if cell.get("outputs"))
    cell.execution_count = None
    cell.outputs = []


def skip_a_cell(notebook) -> None:
    next(cell for cell in notebook.cells if cell.cell_type == "code").metadata["tags"] = ["nbval-skip"]


def test_each_output_that_differs_is_red_and_the_others_are_green(tmp_path):
    """Our own pytest command judges the quickest chapter, in which three outputs differ."""
    for name in ("pyproject.toml", "tests/conftest.py", "tests/processes.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    notebook = notebooks.read(ROOT / "notebooks" / QUICKEST)
    make_three_outputs_differ(notebook)
    (tmp_path / "notebooks").mkdir()
    notebooks.write(notebook, tmp_path / "notebooks" / "differing.ipynb")
    command = [sys.executable, "-m", "pytest", "-q", "-n0", "-p", "no:cacheprovider", "--junitxml=result.xml"]
    done = run([*command, "notebooks"], cwd=tmp_path)
    assert done.returncode == 1, done.stdout + done.stderr
    cases = list(ET.parse(tmp_path / "result.xml").iter("testcase"))
    red = [case for case in cases if case.find("failure") is not None or case.find("error") is not None]
    assert (len(red), len(cases) > 10) == (3, True)


def lose_a_backslash(notebook) -> None:
    notebook.cells[0].source += "\n$\alpha$"


@pytest.mark.parametrize("tamper", [forget_an_execution, empty_a_cell, skip_a_cell, lose_a_backslash])
def test_a_stored_form_that_was_tampered_with_is_red(tamper):
    notebook = notebooks.read(ROOT / "notebooks" / QUICKEST)
    tamper(notebook)
    assert list(notebooks.problems(notebook)) != []
