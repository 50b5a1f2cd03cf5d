"""The chapter A goal by click: what its cells show, and another right answer."""

from __future__ import annotations

from rosmini.book.checks import Script, Status, find

from .conftest import printed
from .mistakes.navigation_goal import WAITER


def test_goals_of_all_kinds_are_reached(cells):
    for cell in ("6.3 -2.0 -1.57", "orientation: {w: 1}}}", "4.0 0.0 0"):
        assert "move_base: Goal reached." in printed(cells, cell)


def test_an_errand_that_takes_too_long_is_cancelled(cells):
    errand = next(i for i, cell in enumerate(cells) if "%%node errand.py" in cell.source)
    assert printed(cells[errand + 1 : errand + 2], "rosmini.wait(14)").rstrip().endswith("PREEMPTED")


def test_the_diagram_of_a_click_has_the_message_of_move_base_to_itself(figures):
    assert "/move_base_node -> /move_base_node: /move_base/goal" in figures[5]


def test_the_slip_is_answered_by_the_command_that_was_meant(cells):
    assert "If an executable was meant: rosrun map_server map_saver" in printed(cells, "map_saver -f my_map")


def test_one_call_may_do_what_three_do():
    text = WAITER.partition("    client.send_goal(goal)\n")[0]
    answer = Script("waiter.py", f"{text}    client.send_goal_and_wait(goal, rospy.Duration(25))\n")
    assert find("waiter").grade(answer).status is Status.RIGHT
