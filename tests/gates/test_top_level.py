"""At the top lie the folders of the project and the usual files, and nothing that somebody left there."""

from __future__ import annotations

from pathlib import Path

import pytest

from ..processes import run

ROOT = Path(__file__).resolve().parents[2]
ALLOWED = {
    *("book", "rosmini", "notebooks", "assets", "tests", "pyproject.toml", "README.md"),
    *("LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff"),
}


def test_only_the_projects_own_files_lie_at_the_top():
    if not (ROOT / ".git").exists():
        pytest.skip("not a checkout of git: what a build puts beside the sources cannot be told from them")
    top = {
        line.partition("/")[0] for line in run(["git", "ls-files"], cwd=ROOT, text=True, check=True).stdout.splitlines()
    }
    assert {name for name in top if not name.startswith(".")} <= ALLOWED
