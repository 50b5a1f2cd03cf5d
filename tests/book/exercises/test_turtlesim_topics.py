"""The chapter turtlesim: topics: what its cells say, and other right answers."""

from __future__ import annotations

from rosmini.book.checks import Script, Status, find

from .conftest import printed
from .mistakes.turtlesim_topics import TRIANGLE


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
    assert find("corner").grade("c c a a a").status is Status.RIGHT


def test_what_was_drawn_before_may_be_wiped():
    wiped = TRIANGLE.replace("pen(255, 0, 0, 5, 1)\njump(2, 2, 0)\n", "jump(2, 2, 0)\nclear()\n").replace(
        "pen = ", 'clear = rospy.ServiceProxy("clear", Empty)\npen = '
    )
    answer = Script("triangle.py", f"from std_srvs.srv import Empty\n{wiped}")
    assert find("triangle").grade(answer).status is Status.RIGHT
