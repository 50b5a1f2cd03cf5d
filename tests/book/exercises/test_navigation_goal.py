"""The chapter A goal by click: what its cells say, and another right answer."""

from __future__ import annotations

from rosmini.book.checks import Script, Status, find

from .conftest import printed
from .mistakes.navigation_goal import WAITER


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
    assert find("waiter").grade(answer).status is Status.RIGHT
