"""The chapter The command line: its cheat sheet agrees with the page of commands, and its cells with the text."""

from __future__ import annotations

import re

import pytest

from .conftest import NOTEBOOKS, printed


def test_the_cheat_sheet_agrees_with_the_page_of_commands(cells):
    [sheet] = re.findall(r"## Cheat sheet\n(.*?)\n## ", "\n".join(cell.source for cell in cells), re.DOTALL)
    page = (NOTEBOOKS.parent / "book" / "commands.md").read_text(encoding="utf-8").splitlines()
    commands = re.findall(r"`(ros\w+)(?: (\w+)[^`]*)?`", sheet)
    assert len(commands) > 30
    for tool, verb in commands:
        [row] = [line for line in page if line.startswith("| ") and f"`rosmini {tool}" in line]
        assert re.search(rf"[` ]{verb}[`\s]", row), f"{tool} {verb} is not in: {row}"


def test_the_mistyped_topic_is_found_and_corrected(cells):
    said = printed(cells, "cmd_vel:=cmd_val")
    assert "/cmd_vel, to which /simulator subscribes" in said
    assert "did you mean /cmd_val?" in said
    [corrected] = [
        cell for cell in cells if cell.cell_type == "code" and "%roswtf" in cell.source and "cmd_val" not in cell.source
    ]
    assert "Nobody publishes" not in "".join(output.get("text", "") for output in corrected.outputs)


def test_the_parameter_slows_the_robot_down(cells):
    [speed] = re.findall(r"^(0\.\d+)", printed(cells, "%rosparam set"), re.MULTILINE)
    assert float(speed) == pytest.approx(0.1, abs=0.01)
