"""Chapter 17: its figures are numbered, and its program starts from a terminal as the page and exercises say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from book.tools import notebooks

from .conftest import assert_figures_are_numbered, run_rosmini

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "17_names.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


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
    from rosmini.book.exercises.chapter_17 import TALKER

    for line in ('rospy.init_node("talker")', 'rospy.Publisher("chatter", String', 'rospy.get_param("~text"'):
        assert line in talker
        assert line in TALKER


def test_every_figure_is_numbered_in_order():
    assert_figures_are_numbered(CHAPTER.stem, ("rqt_graph(",))
