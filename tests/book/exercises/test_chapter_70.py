"""Chapter 70: its size, its figures, and what its cells say."""

from __future__ import annotations

import pytest

from book.tools import notebooks
from rosmini.book.checks import Script, Status, find

from .conftest import NOTEBOOKS, assert_short, figure_numbers, printed
from .mistakes.chapter_70 import WAITER

CHAPTER = NOTEBOOKS / "70_navigation_goal.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert figure_numbers(CHAPTER.stem) == [1, 2, 3, 4, 5, 6, 7, 8]


def test_goals_of_all_kinds_are_reached(cells):
    for begin in ("rosmini.wait(12)", "%rostopic pub -1"):
        assert "move_base says: Goal reached." in printed(cells, begin)
    assert printed(cells, "rosmini.wait(34)").count(": Goal reached.") == 4
    assert "PREEMPTED" in printed(cells, "rosmini.wait(14)")


def test_the_slip_is_answered_by_the_command_that_was_meant(cells):
    assert "If an executable was meant: rosrun map_server map_saver" in printed(cells, "map_saver -f my_map")


def test_a_robot_that_was_carried_away_is_lost_until_it_is_told(cells):
    lost, found = printed(cells, "def compare"), printed(cells, "2D Pose Estimate")
    assert not lost.startswith("amcl is 0 m off")
    assert "amcl is 0 m off" in found
    assert "Goal reached." in found


def test_one_call_may_do_what_three_do():
    text = WAITER.partition("    client.send_goal(goal)\n")[0]
    answer = Script("waiter.py", f"{text}    client.send_goal_and_wait(goal, rospy.Duration(5))\n")
    assert find("70.3").grade(answer).status is Status.RIGHT
