"""Chapter 13: the scripts that it lists print what the page shows; its figures are numbered; what it says of the tools is true."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from rosmini.book import notebooks
from rosmini.msgs import service_class

CHAPTER = Path(__file__).resolve().parents[2] / "notebooks" / "13_services.ipynb"


@pytest.fixture(scope="module")
def prose():
    return "\n\n".join(cell.source for cell in notebooks.read(CHAPTER).cells if cell.cell_type == "markdown")


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    scripts = dict(re.findall(r"^`(\w+\.py)`:\n\n```python\n(.*?)^```", prose, re.DOTALL | re.MULTILINE))
    assert set(scripts) == {"add_server.py", "add_client.py"}
    for name, text in scripts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    command, shown = re.search(
        r"^```console\n\$ uv run rosmini (run .*?)\n(.*?)^```", prose, re.DOTALL | re.MULTILINE
    ).groups()
    done = subprocess.run(
        [sys.executable, "-m", "rosmini", *shlex.split(command)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, shown, "")


def test_every_figure_is_numbered_in_order():
    code = [cell.source for cell in notebooks.read(CHAPTER).cells if cell.cell_type == "code"]
    numbers = [int(number) for source in code for number in re.findall(r"Figure 13\.(\d+): ", source)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert sum(source.count(".show(") for source in code) == len(numbers) > 0


def test_the_answers_of_rossrv_are_true(prose):
    box = re.search(r"\$ rossrv show (\S+)\n(.*?)\n>\n> \$ rossrv md5 (\S+)\n> (\w+)", prose, re.DOTALL)
    shown, text, fingerprinted, md5 = box.groups()
    cls = service_class(shown)
    halves = [
        [f"{field.type} {field.name}" for field in half._spec.fields]
        for half in (cls._request_class, cls._response_class)
    ]
    assert [line.removeprefix("> ") for line in text.splitlines()] == [*halves[0], "---", *halves[1]]
    assert service_class(fingerprinted)._md5sum == md5
