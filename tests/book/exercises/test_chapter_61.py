"""Chapter 61: its size, its figures, and what its cells say."""

from __future__ import annotations

import pytest

from book.tools import notebooks
from rosmini.book.checks import Script, Status, find

from .conftest import NOTEBOOKS, assert_figures_are_numbered, assert_short, printed
from .mistakes.chapter_61 import TRIANGLE

CHAPTER = NOTEBOOKS / "61_turtlesim_topics.ipynb"


@pytest.fixture(scope="module")
def cells():
    return notebooks.read(CHAPTER).cells


def test_it_is_as_short_as_a_chapter_has_to_be(cells):
    assert_short(cells)


def test_its_figures_are_numbered():
    assert_figures_are_numbered("61_turtlesim_topics", (".replay(", ".show(", "%rqt_graph"))


def test_each_key_is_one_message_and_a_wrong_name_is_no_error(cells):
    assert "/turtle1/cmd_vel" in printed(cells, "rostopic list -v")
    assert "average rate: 62.5" in printed(cells, "rostopic hz")
    said = printed(cells, "cmd_vell")
    assert said.count("$ rostopic pub") == 2


def test_services_say_what_they_cannot_do(cells):
    said = printed(cells, "/kill turtle7")
    assert said.count("ERROR") >= 2
    assert "11.08" in said


def test_keys_may_be_apart_and_small():
    assert find("61.1").grade("c c a a a").status is Status.RIGHT


def test_what_was_drawn_before_may_be_wiped():
    wiped = TRIANGLE.replace("pen(255, 0, 0, 5, 1)\njump(2, 2, 0)\n", "jump(2, 2, 0)\nclear()\n").replace(
        "pen = ", 'clear = rospy.ServiceProxy("clear", Empty)\npen = '
    )
    answer = Script("triangle.py", f"from std_srvs.srv import Empty\n{wiped}")
    assert find("61.2").grade(answer).status is Status.RIGHT
