"""The measurement of chapters: what `--costs` writes, and what the book says about it."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

import nbformat
import pytest

from book.tools import costs
from book.tools.reference import CostTable

from ..conftest import nightly
from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
NEEDS_PROC = pytest.mark.skipif(not Path("/proc/self/status").is_file(), reason="only Linux has /proc/PID/status")


@NEEDS_PROC
@pytest.mark.parametrize("processes", [0, *nightly(2)])
def test_costs_has_a_line_for_each_notebook(tmp_path, processes):
    for name, megabytes in (("small", 1), ("large", 200)):
        sources = (f"block = b'x' * ({megabytes} * 10**6)", "del block")
        cells = [nbformat.v4.new_code_cell(source, execution_count=1) for source in sources]
        notebook = nbformat.v4.new_notebook(cells=[*cells, nbformat.v4.new_markdown_cell("text")])
        nbformat.write(notebook, tmp_path / f"{name}.ipynb")
    (tmp_path / "test_other.py").write_text("def test(): pass\n", encoding="utf-8")
    (tmp_path / "pages").mkdir()
    (tmp_path / "pages" / "small.html").write_text("x" * 4000, encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "--nbval", "--nbval-current-env", "-p", "book.tools.pytest_plugin"]
    options = ["-p", "no:cacheprovider", f"-n{processes}", "--dist=loadfile", "--costs", "costs.json", "."]
    done = run([*command, *options], cwd=tmp_path, env=os.environ | {"ROSMINI_BOOK": "pages"})
    assert done.returncode == 0, done.stdout
    measured, chapters = costs.read(tmp_path / "costs.json")
    assert measured.keys() == {"date", "commit", "machine"}
    assert chapters.keys() == {"small", "large"}
    small, large = chapters["small"], chapters["large"]
    assert small["cells"] == 2
    assert small["page"] == 4
    assert "page" not in large
    assert large["memory"] > small["memory"] + 150
    assert small["cpu"] > 0


def test_a_process_that_has_ended_has_no_costs():
    assert costs.of_process(2**22 + 1) == {}


def test_the_table_has_all_chapters_of_the_book_and_the_machine():
    measured, chapters = costs.read()
    table = "\n".join(CostTable.lines(CostTable.__new__(CostTable)))
    assert measured["machine"] in table
    assert measured["commit"] in table
    toc = re.findall(r"file: (notebooks/\S+)", (ROOT / "book" / "_toc.yml").read_text(encoding="utf-8"))
    assert re.findall(r"{doc}`/(notebooks/\S+)`", table) == toc
    assert chapters.keys() == set(toc), "measure again: the page What the chapters cost says how"


def test_the_memory_to_allow_a_student_is_enough():
    page = (ROOT / "book" / "for_your_course.md").read_text(encoding="utf-8")
    (allowed,) = re.findall(r"Allow (\d+) GB for each student", page)
    largest = costs.largest()
    assert 1.5 * largest["memory"] < 1000 * int(allowed)
