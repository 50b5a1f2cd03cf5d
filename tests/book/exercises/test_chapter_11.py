"""The scripts that chapter 11 lists: run from the page by the command on the page, they print what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from .conftest import assert_figures_are_numbered, assert_scripts_print_what_is_shown, prose_of

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "11_nodes_and_master.ipynb"


@pytest.fixture(scope="module")
def prose():
    return prose_of(CHAPTER.stem)


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"talker.py", "listener.py"})


def test_every_figure_is_numbered_in_order():
    assert_figures_are_numbered(CHAPTER.stem, ("rqt_graph(",))
