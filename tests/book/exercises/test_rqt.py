"""The chapter on rqt says what rqt does."""

from __future__ import annotations

from pathlib import Path

from book.tools import notebooks
from rosmini.viz.rqt.selection import MEANING

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks/6_simulators/40_rqt.ipynb"


def test_the_table_says_what_each_switch_hides() -> None:
    text = "\n".join(notebooks.prose(notebooks.read(CHAPTER)))
    for name, meaning in MEANING.items():
        assert f"`--hide {name}` | {meaning} |" in text
