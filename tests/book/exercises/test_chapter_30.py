"""Chapter 30: its size, its figures, and what its cells say."""

from __future__ import annotations

import pytest

from book.tools import notebooks
from rosmini.book.checks import Status, find

from .conftest import NOTEBOOKS, assert_figures_are_numbered, assert_short, printed

CHAPTER = NOTEBOOKS / "30_navigation_stack.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert_figures_are_numbered(
        "30_navigation_stack", (".replay(", "tf_tree(", "%rqt_graph", "move_base.show(", "still(")
    )


def test_the_robot_arrives(cells):
    assert "Goal reached." in printed(cells, "def tell(result)")
    assert "it is 0.1 m from the goal" in printed(cells, "run.pose_at")


def test_the_stack_has_its_parts(cells):
    listed = printed(cells, "%rosnode list")
    assert all(f"/{name}\n" in listed for name in ("map_server", "move_base", "fake_localization"))
    assert "navfn" in printed(cells, "%rospack plugins")


def test_a_length_may_be_added_up_in_a_loop():
    def length(poses):
        total = 0
        for number in range(1, len(poses)):
            a, b = poses[number - 1].pose.position, poses[number].pose.position
            total += ((a.x - b.x) ** 2 + (a.y - b.y) ** 2) ** 0.5
        return total

    assert find("30.3").grade(length).status is Status.RIGHT
