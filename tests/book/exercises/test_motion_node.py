"""The chapter A node that moves: what its cells say, and other right answers."""

from __future__ import annotations

import re

from rosmini.book.checks import Script, Status, find

from .conftest import printed
from .mistakes.motion_node import CORNERS, TURN


def test_the_script_of_the_tutorials_fails_and_once_corrected_never_ends(cells):
    assert "TypeError: bad operand type for abs(): 'str'" in printed(cells, "    speed = input(")
    assert "/robot_cleaner_" in printed(cells, "%rostopic hz")


def test_the_corrected_script_ends(cells):
    assert printed(cells, "rosmini.wait(4)\n%rosnode list").endswith("/rosout\n/turtlesim\n")


def test_the_controller_errs_least_and_the_wall_is_told_by_those_that_look(cells):
    table = printed(cells, "for speed, distance in")
    rows = [line.split() for line in table.splitlines() if re.match(r" *[0-9]", line)]
    for _, asked, straight, measured, goal in rows[:3]:
        errors = [abs(float(gone) - float(asked)) for gone in (straight, measured, goal)]
        assert errors[2] == min(errors)
    assert rows[3].count("no") == 2  # only the script that does not look believes that it is through


def test_a_turn_may_count_its_rounds():
    counted = TURN.replace("while 0.5 * (rospy.Time.now() - start).to_sec() < math.pi / 2:", "for _ in range(62):")
    assert find("turn").grade(Script("turn.py", counted)).status is Status.RIGHT


def test_a_turtle_that_stops_at_the_edge_of_a_goal_has_been_there():
    late = CORNERS.replace("> 0.05", "> 0.095").replace("min(1.5, 2 * far)", "2.0")
    assert find("corners").grade(Script("corners.py", late)).status is Status.RIGHT
