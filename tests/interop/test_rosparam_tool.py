"""`rosmini rosparam` beside the real tool, at one real Master."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Any

import pytest

from ..processes import run
from .conftest import need_ros

need_ros("rosparam")

CHANGES = [
    "rosparam set /g '{p: 1, q: {r: 2.5, s: [a, b]}}'", "rosparam set -v /x -5", "rosparam set /e ''",
    "rosparam set /text -t t.txt", "rosparam load -v p.yaml /ns", "rosparam set -v /g/q/r 3",
    "rosparam delete -v /ns/a",
    "rosparam set /angle 'deg(90)'", "rosparam delete /nope", "rosparam load none.yaml",
]  # fmt: skip
QUESTIONS = [
    "get /", "get /g", "get -p /g", "get /x", "get /e", "get -p /e", "get /text", "get -p /text", "get /ns",
    "get /angle", "get -v /g/q", "list", "list /g", "list /nope", "get", "get a b", "set", "set /x", "list a b", "load",
    "dump -v d.yaml /g", "dump", "set /a -t none.txt", "bogus",
]  # fmt: skip


def tool(env: dict[str, str], folder: Path, line: str, *, ours: bool) -> Any:
    words = shlex.split(line)
    words = [sys.executable, "-m", "rosmini", *words] if ours else words
    return run(words, env=env, cwd=folder)


def test_the_same_lines_do_the_same(master: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text(
        "a: 1\nb: {c: [1, 2], d: -5}\n---\n_ns: sub\nz: rad(pi)\n", encoding="utf-8"
    )
    (tmp_path / "t.txt").write_text("hello\nworld\n", encoding="utf-8")
    state: list[str] = []
    for ours in (False, True):
        tool(master, tmp_path, "rosparam delete /", ours=ours)
        said = []
        for line in CHANGES:
            done = tool(master, tmp_path, line, ours=ours)
            said.append((line, done.returncode, done.stdout, done.stderr.partition("\n")[0]))
        found = tool(master, tmp_path, "rosparam get /", ours=False).stdout
        state.append(f"{said}\n{found}")
    assert state[0] == state[1]
    for line in QUESTIONS:
        real, mine = (tool(master, tmp_path, f"rosparam {line}", ours=ours) for ours in (False, True))
        assert (line, mine.stdout, mine.returncode) == (line, real.stdout, real.returncode)
        assert mine.stderr.startswith(real.stderr)


def test_bytes_come_back(master: dict[str, str], tmp_path: Path) -> None:
    """The real tool sets them, and cannot print them."""
    (tmp_path / "b.bin").write_bytes(b"\x00\xff")
    assert tool(master, tmp_path, "rosparam set /bytes -b b.bin", ours=False).returncode == 0
    assert "!!binary" in tool(master, tmp_path, "rosparam get /bytes", ours=True).stdout
    assert tool(master, tmp_path, "rosparam set /more -b b.bin", ours=True).returncode == 0
    assert tool(master, tmp_path, "rosparam get /more", ours=True).stdout == (
        tool(master, tmp_path, "rosparam get /bytes", ours=True).stdout
    )
    assert tool(master, tmp_path, "rosparam delete /", ours=True).returncode == 0


@pytest.mark.parametrize("line", ["rosparam get /nope", "rosparam delete /nope"])
def test_errors_begin_as_the_real_ones(master: dict[str, str], tmp_path: Path, line: str) -> None:
    real, ours = (tool(master, tmp_path, line, ours=mine) for mine in (False, True))
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode)
    assert ours.stderr.startswith(real.stderr)
