"""Chapter 21: its size, its figures, and that each status it explains is printed."""

from __future__ import annotations

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_figures_are_numbered, assert_short, printed, prose_of

CHAPTER = NOTEBOOKS / "21_rviz.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert_figures_are_numbered("21_rviz", ("%rviz ", "still(scene, title="))


def test_its_pictures_are_light(cells):
    for cell in cells:
        for output in cell.get("outputs", []):
            svg = output.get("data", {}).get("image/svg+xml", "")
            assert len(svg) <= 60_000


def test_the_statuses_that_it_explains_are_those_that_are_printed(cells):
    said = printed(cells, "as faulty:")
    for words in (
        "Fixed Frame: OK", "For frame [base_scan]", "No transform from [base_scan] to [odom]", "nobody publishes /scam",
        "has the type sensor_msgs/LaserScan",
    ):  # fmt: skip
        assert words in said
    assert "No transform from [base_scan]" in prose_of("21_rviz")
    after = printed(cells, "remote.launch model:=burger\nrosmini.wait(1)")
    assert "Error" not in after and "Warn" not in after
