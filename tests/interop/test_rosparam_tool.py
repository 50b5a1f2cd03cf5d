"""`rosmini rosparam` beside the real tool, at one real Master."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from .conftest import need_ros

if TYPE_CHECKING:
    from pathlib import Path

    from .conftest import Tools

need_ros("rosparam")

CHANGES = [
    "rosparam set /g '{p: 1, q: {r: 2.5, s: [a, b]}}'", "rosparam set -v /x -5", "rosparam set /e ''",
    "rosparam load -v p.yaml /ns", "rosparam set -v /g/q/r 3",
    "rosparam delete -v /ns/a",
    "rosparam set /angle 'deg(90)'", "rosparam delete /nope", "rosparam load none.yaml",
]  # fmt: skip
QUESTIONS = [
    "get /", "get /g", "get -p /g", "get /x", "get /e", "get -p /e", "get /ns",
    "get /angle", "get -v /g/q", "list", "list /g", "list /nope", "get", "get a b", "set", "set /x", "list a b", "load",
    "dump -v d.yaml /g", "dump", "bogus",
]  # fmt: skip


@pytest.mark.nightly
def test_the_same_lines_do_the_same(tools: Tools, tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text("a: 1\nb: {c: [1, 2], d: -5}\n---\n_ns: sub\nz: rad(pi)\n", encoding="utf-8")
    state = []
    for tool in (tools.real, tools.ours):
        tool("rosparam delete /")
        said = []
        for line in CHANGES:
            done = tool(line, cwd=tmp_path)
            said.append((line, done.returncode, done.stdout, done.stderr.partition("\n")[0]))
        state.append((said, tools.real("rosparam get /").stdout))
    assert state[0] == state[1]
    for line in QUESTIONS:
        real, ours = tools.both(f"rosparam {line}", cwd=tmp_path)
        assert (line, ours.stdout, ours.returncode) == (line, real.stdout, real.returncode)
        assert ours.stderr.startswith(real.stderr)


def test_bytes_come_back(tools: Tools, tmp_path: Path) -> None:
    """The real tool sets them, and cannot print them."""
    (tmp_path / "b.bin").write_bytes(b"\x00\xff")
    assert tools.real("rosparam set /bytes -b b.bin", cwd=tmp_path).returncode == 0
    assert "!!binary" in tools.ours("rosparam get /bytes").stdout
    assert tools.ours("rosparam delete /").returncode == 0


@pytest.mark.parametrize("line", ["rosparam get /nope", "rosparam delete /nope"])
def test_errors_begin_as_the_real_ones(tools: Tools, line: str) -> None:
    real, ours = tools.both(line)
    assert (ours.stdout, ours.returncode) == (real.stdout, real.returncode)
    assert ours.stderr.startswith(real.stderr)
