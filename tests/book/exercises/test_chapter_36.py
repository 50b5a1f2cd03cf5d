"""Chapter 36: its size, its figures, and that its robot is found, lost and found as the text says."""

from __future__ import annotations

import pytest

from book.tools import notebooks

from .conftest import NOTEBOOKS, assert_short, figure_numbers, printed

CHAPTER = NOTEBOOKS / "36_amcl.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_every_figure_is_numbered_in_order():
    assert figure_numbers(CHAPTER.stem) == list(range(1, 7))


def test_amcl_finds_the_robot_and_so_does_the_filter_by_hand(cells):
    _, base, truth = printed(cells, "listener = TransformListener()").splitlines()
    found, wanted = ([float(v) for v in line.partition(":")[2].split()] for line in (base, truth))
    assert found == pytest.approx(wanted, abs=0.4)
    [text] = [
        output.data["text/plain"]
        for cell in cells
        for output in cell.get("outputs", ())
        if output.get("data", {}).get("text/plain", "").startswith("Figure 36.3")
    ]
    assert float(text.rpartition("mean ")[2].split()[0]) < 0.4


def test_a_kidnapped_robot_stays_lost_until_somebody_helps(cells):
    lost = [float(v) for v in printed(cells, "robot.place((-6.5").split()]
    assert min(lost) > 2.0
    helped = printed(cells, 'tools["2D Pose Estimate"]').splitlines()[-1].split()
    assert max(map(float, helped)) < 0.5
