"""The script of the chapter The Parameter Server: run by the commands on the page, it prints what the page shows."""

from __future__ import annotations

import re

from rosmini.core.rosparam import load_str

from .conftest import run_rosmini


def test_the_listed_script_prints_what_is_shown(prose, tmp_path):
    scripts = dict(re.findall(r"^`(\w+\.py)`:\n\n```python\n(.*?)^```", prose, re.DOTALL | re.MULTILINE))
    assert set(scripts) == {"beacon.py"}
    (tmp_path / "beacon.py").write_text(scripts["beacon.py"], encoding="utf-8")
    (shown,) = re.findall(r"^```console\n(\$ uv run rosmini run .*?)^```", prose, re.DOTALL | re.MULTILINE)
    runs = re.findall(r"^\$ uv run rosmini (.*)\n((?:(?!\$ ).*\n)*)", shown, re.MULTILINE)
    assert len(runs) == 2
    for command, expected in runs:
        assert run_rosmini(command, tmp_path) == (0, expected, "")


def test_the_files_in_the_boxes_are_what_is_got(prose):
    given = re.search(r"^\$ cat robot\.yaml\n(.*?)^\$", prose, re.DOTALL | re.MULTILINE).group(1)
    saved = re.search(r"^\$ cat saved\.yaml\n(.*?)^```", prose, re.DOTALL | re.MULTILINE).group(1)
    (before,), (after,) = load_str(given), load_str(saved)
    before.values["wheel"]["radius"] = 0.035  # as `rosparam set` in the box
    assert after.values == before.values
