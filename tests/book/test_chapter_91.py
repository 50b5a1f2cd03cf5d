"""The scripts that chapter 91 lists: run from the page by the command on the page, they print what the page shows."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from rosmini.book import notebooks

CHAPTER = Path(__file__).resolve().parents[2] / "notebooks" / "91_actionlib.ipynb"


@pytest.fixture(scope="module")
def prose():
    cells = notebooks.read(CHAPTER).cells
    return "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    scripts = dict(re.findall(r"^`(\w+\.py)`:\n\n```python\n(.*?)^```", prose, re.DOTALL | re.MULTILINE))
    assert set(scripts) == {"fibonacci_server.py", "fibonacci_client.py"}
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
    numbers = [int(number) for source in code for number in re.findall(r"Figure 91\.(\d+): ", source)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) == 5
