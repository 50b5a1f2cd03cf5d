"""The chapter Names: its program starts from a terminal as the page and exercises say."""

from __future__ import annotations

import re

import pytest

from .conftest import run_rosmini


@pytest.fixture(scope="module")
def talker(cells):
    sources = [cell.source for cell in cells if cell.cell_type == "code" and 'TALKER = """' in cell.source]
    return re.search(r'TALKER = """\n(.*?)"""', sources[0], re.DOTALL)[1]


def test_the_talker_starts_from_a_terminal_as_shown(cells, talker, tmp_path):
    (tmp_path / "talker.py").write_text(talker, encoding="utf-8")
    prose = "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    command, shown = re.search(r"^\$ uv run rosmini (run .*?)\n(.*?)\n```", prose, re.MULTILINE).groups()
    assert run_rosmini(command, tmp_path) == (0, shown + "\n", "")


def test_the_exercise_starts_the_same_talker(talker):
    from rosmini.book.exercises.names import TALKER

    for line in ('rospy.init_node("talker")', 'rospy.Publisher("chatter", String', 'rospy.get_param("~text"'):
        assert line in talker
        assert line in TALKER
