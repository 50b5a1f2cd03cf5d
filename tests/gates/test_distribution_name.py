"""Nothing tells a reader to install `rosmini` from the package index: there that name belongs to another project."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
INSTALLS_ANOTHER_PROJECT = re.compile(r"pip3? install [^\n`&;]*\brosmini(?![-\w/.])")
"""A command that installs a distribution called rosmini, with or without extras."""


@pytest.mark.parametrize(
    "command", ["pip install rosmini", "pip install -U 'rosmini[book]'", "pip install numpy rosmini"]
)
def test_a_command_that_installs_another_project_is_found(command):
    assert INSTALLS_ANOTHER_PROJECT.search(command)


@pytest.mark.parametrize(
    "command", ["pip install uv && uv run pytest", "pip install rosmini-ros", "pip install '.[book]'"]
)
def test_a_command_that_installs_ours_or_something_else_is_allowed(command):
    assert not INSTALLS_ANOTHER_PROJECT.search(command)


def test_no_text_of_ours_installs_another_project():
    found = []
    for folder in ("rosmini", "book", "notebooks", "assets", ".github"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in {".py", ".md", ".ipynb", ".js", ".yml", ".xml", ".html"} and "_build" not in path.parts:
                text = path.read_text(encoding="utf-8")
                found += [f"{path.relative_to(ROOT)}: {each}" for each in INSTALLS_ANOTHER_PROJECT.findall(text)]
    for path in (*ROOT.glob("*.md"), ROOT / "CITATION.cff"):
        if INSTALLS_ANOTHER_PROJECT.search(path.read_text(encoding="utf-8")):
            found.append(path.name)
    assert not found


def test_the_distribution_has_a_name_of_its_own():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["name"] == "rosmini-ros"
    assert "rosmini" in project["scripts"]
