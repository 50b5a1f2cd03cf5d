"""What the README shows is what happens."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.specifiers import SpecifierSet

from .processes import run

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(language: str, place: int = 0) -> str:
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.DOTALL | re.MULTILINE)[place]


def test_the_example_prints_what_is_shown(tmp_path):
    (tmp_path / "circle.py").write_text(block("python"), encoding="utf-8")
    [words] = re.findall(r"^\$ uv run rosmini (.* circle\.py .*)$", README, re.MULTILINE)
    done = run([sys.executable, "-m", "rosmini", *words.split()], cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, block("text"), "")


def test_the_example_has_ten_lines():
    assert len([line for line in block("python").splitlines() if line.strip()]) == 10


@pytest.mark.parametrize("target", re.findall(r'(?:\]\(|src=")([^)"#:]+)[)"]', README))
def test_what_the_readme_points_to_is_there(target):
    assert (ROOT / target).exists()


def test_the_page_on_the_comparison_has_each_figure_of_the_readme():
    comparison = README.partition("\n## How it compares\n")[2].partition("\n## ")[0]
    [(page, anchor)] = re.findall(r"\]\(([\w/]+\.md)#([\w-]+)\)", comparison)
    heading = anchor.replace("-", " ").capitalize()
    section = (ROOT / page).read_text(encoding="utf-8").partition(f"\n## {heading}\n")[2]
    figures = re.findall(r"\b[\d.]+ (?:GB|MB|s)\b", comparison)
    assert len(figures) > 10
    assert [figure for figure in figures if figure not in section] == []


def test_ci_runs_the_commands_of_the_readme_as_they_stand_there():
    shown = re.findall(r"^\$ (.+)$", README.partition("## Ten lines")[0], re.MULTILINE)
    one_line = ["pip install uv && uv run rosmini book", "pip install uv && uv run pytest"]
    assert shown == [*one_line, "python -m pip install uv", "python -m uv run rosmini book"]
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]
    run = {name: [step["run"] for step in job["steps"] if "run" in step] for name, job in jobs.items()}
    assert [line for line in run["readme"] if line in one_line] == one_line
    assert set(shown[2:]) < set(run["powershell"])
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    assert "uv run pytest\n" in script
    assert "uv run rosmini book --no-open\n" in script


def test_the_versions_of_python_agree():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    allowed = SpecifierSet(project["requires-python"])
    named = re.findall(r":: (3\.\d+)$", "\n".join(project["classifiers"]), re.MULTILINE)
    assert named == [f"3.{minor}" for minor in range(50) if f"3.{minor}" in allowed]
    assert f"with Python {named[0]} to {named[-1]}." in README
    matrix = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]["readme"][
        "strategy"
    ]["matrix"]
    assert matrix["python"] == [named[0], named[-1]]


def test_the_citation_has_the_address_of_the_repository_once_it_is_known():
    url = yaml.safe_load((ROOT / "book" / "_config.yml").read_text(encoding="utf-8"))["repository"]["url"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation.get("repository-code", "") == url


def test_the_versions_agree():
    import rosmini

    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {rosmini.__version__}\n" in citation
    assert f"## {rosmini.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["dynamic"] == ["version"]
