"""The examples of the page "Where things go" are complete: written to files, they pass the tests shown there."""

from __future__ import annotations

import os
import re
import shutil
import sys
import tomllib
from pathlib import Path

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from book.tools import notebooks, solutions

from ..conftest import tool
from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "book" / "about" / "where_things_go.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^`([\w./]+)`:\n\n(`{3,})\w+\n(.*?)^\2\n", re.DOTALL | re.MULTILINE)
EXAMPLES = {
    title: [(name, text) for name, _, text in BLOCK.findall(section)]
    for title, section in re.findall(r"^### (An? .+?)\n(.*?)(?=^### An? |\Z)", PAGE, re.DOTALL | re.MULTILINE)
}
CELL = re.compile(r"^# %%( \[markdown\])?( hide-input)?\n(.*?)(?=^# %%|\Z)", re.DOTALL | re.MULTILINE)


def environment(checkout: Path) -> dict[str, str]:
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_XDIST")}
    return own | {"PYTHONPATH": str(checkout)}


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A copy of the library with the files of all examples in their places."""
    folder = tmp_path_factory.mktemp("checkout")
    ignored = shutil.ignore_patterns("__pycache__")
    for name in ("rosmini", "assets"):
        shutil.copytree(ROOT / name, folder / name, ignore=ignored)
    for path in (ROOT / "tests").rglob("*.py"):  # what the examples' tests share with others
        if not path.name.startswith("test_"):
            copied = folder / path.relative_to(ROOT)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, copied)
    groups: dict[str, list[str]] = {}
    for name, text in (block for blocks in EXAMPLES.values() for block in blocks):
        if name == "pyproject.toml":
            for group, entries in tomllib.loads(text)["project"]["entry-points"].items():
                groups.setdefault(group, []).extend(f"{key} = {value}" for key, value in entries.items())
        else:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8")
    info = folder / "examples-1.0.dist-info"
    info.mkdir()
    info.joinpath("METADATA").write_text("Metadata-Version: 2.1\nName: examples\nVersion: 1.0\n", encoding="utf-8")
    listed = "\n\n".join("\n".join([f"[{group}]", *entries]) for group, entries in groups.items())
    info.joinpath("entry_points.txt").write_text(listed, encoding="utf-8")
    return folder


def test_there_is_one_for_each_kind_of_thing():
    assert list(EXAMPLES) == ["A node", "A global planner", "A sensor", "A display", "A verb", "A chapter"]


def test_their_own_tests_pass(checkout):
    tests = [name for blocks in EXAMPLES.values() for name, _ in blocks if name.startswith("tests/")]
    assert len(tests) == len(EXAMPLES) - 1  # a chapter has no test file
    command = [sys.executable, "-m", "pytest", "-q", "--import-mode=importlib", "-p", "no:cacheprovider", *tests]
    done = run(command, cwd=checkout, env=environment(checkout))
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_chapter_runs_and_its_solution_is_right(checkout, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(checkout))
    name, text = EXAMPLES["A chapter"][0]
    notebook = new_notebook()
    for prose, folded, source in CELL.findall(text):
        cell = (new_markdown_cell if prose else new_code_cell)(source.strip())
        if folded:
            cell.metadata = {"tags": ["hide-input"], "jupyter": {"source_hidden": True}}
        notebook.cells.append(cell)
    solved = solutions.solved(notebook)
    folder = (checkout / name).parent
    for each, verdict in ((notebook, "not attempted yet"), (solved, "right")):
        notebooks.execute(each, folder)
        notebooks.clean(each)
        assert list(notebooks.problems(each)) == []
        assert verdict in solutions.check_output(each, "metres_per_minute")


def test_ruff_has_no_complaints(checkout):
    tool("ruff")
    names = [name for blocks in EXAMPLES.values() for name, _ in blocks if name.endswith(".py")]
    settings = ["--no-cache", "--config", str(ROOT / "pyproject.toml")]
    for command in (["check", "--ignore=D100,INP001,RUF012"], ["format", "--check"]):
        done = run([sys.executable, "-m", "ruff", *command, *settings, *names], cwd=checkout)
        assert done.returncode == 0, done.stdout + done.stderr
