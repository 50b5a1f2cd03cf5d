"""The scripts that chapter 91 lists: run from the page by the command on the page, they print what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from .conftest import assert_scripts_print_what_is_shown, figure_numbers, prose_of

CHAPTER = Path(__file__).resolve().parents[3] / "notebooks" / "91_actionlib.ipynb"


@pytest.fixture(scope="module")
def prose():
    return prose_of(CHAPTER.stem)


def test_the_listed_scripts_print_what_is_shown(prose, tmp_path):
    assert_scripts_print_what_is_shown(prose, tmp_path, {"fibonacci_server.py", "fibonacci_client.py"})


def test_every_figure_is_numbered_in_order():
    numbers = figure_numbers(CHAPTER.stem)
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) == 5
