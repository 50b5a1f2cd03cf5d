"""What the README shows is what happens."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from rosmini.book.pictures import talker_and_listener

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str, place: int = 0) -> str:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.DOTALL | re.MULTILINE)[place]


def test_the_example_prints_what_is_shown(tmp_path):
    (tmp_path / "example.py").write_text(block("python"), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "example.py"], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, block("text"), "")


def test_the_example_has_ten_lines():
    assert len([line for line in block("python").splitlines() if line.strip()]) == 10


def test_the_picture_is_the_graph_as_it_is_drawn_now():
    stored = (ROOT / "book" / "static" / "talker_listener.svg").read_text(encoding="utf-8")
    assert stored == talker_and_listener() + "\n", "run `python -m rosmini.book.pictures`"


@pytest.mark.parametrize("target", re.findall(r'(?:\]\(|src=")([^)"#:]+)[)"]', README))
def test_what_the_readme_points_to_is_there(target):
    assert (ROOT / target).exists()


def test_ci_runs_the_command_of_the_readme():
    assert "pip install uv && uv run pytest" in README
    assert "uv run pytest\n" in (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    for path in (".ci/run", ".github/workflows/ci.yml"):
        text = (ROOT / path).read_text(encoding="utf-8")
        assert "uv run pytest" in text, path
        assert "uv run rosmini book --no-open" in text, path


def test_the_versions_agree():
    import rosmini

    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {rosmini.__version__}\n" in citation
    assert f"## {rosmini.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["dynamic"] == [
        "version"
    ]
