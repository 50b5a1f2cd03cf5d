"""The chapter move_base: what the text says of the stuck robot is what its cells print."""

from __future__ import annotations

import re

import pytest

from rosmini.book.checks import Script, Status, find

from .conftest import printed
from .mistakes.move_base import PATROL


def test_a_goal_that_is_replaced_ends_as_preempted(cells):
    said = printed(cells, "def on_goal(pose)")
    assert "PREEMPTED" in said
    assert re.findall(r"current goal: \((\S+), (\S+)\) in map", said) == [("0.9", "0.9"), ("-1.0", "0.9")]


def test_current_goal_is_not_latched(cells):
    assert not printed(cells, "%rostopic echo -n 1 /move_base/current_goal")


def test_the_recoveries_run_in_the_order_of_the_text(cells):
    stuck = re.findall(r"s: (\w+_re\w+)$", printed(cells, '%drag "toy box" -1.03'), re.MULTILINE)
    assert stuck == ["conservative_reset", "rotate_recovery", "aggressive_reset", "rotate_recovery"]
    helped = printed(cells, "after = around_door()")
    assert re.findall(r"s: (\w+_re\w+)$", helped, re.MULTILINE) == ["conservative_reset"]
    assert "Goal reached." in helped


def test_a_goal_in_a_wall_has_a_plan_with_tolerance_only(cells):
    *_, wall, near = printed(cells, "def length").strip().splitlines()
    assert wall.endswith(" 0.0 m")
    assert not near.endswith(" 0.0 m")


def test_a_misspelt_frame_is_named(cells):
    assert "It is instead in the maps frame" in printed(cells, "frame_id: maps")


@pytest.mark.nightly  # that it is wrong, test_checks says at each commit
def test_a_patrol_that_does_not_wait_is_told_so():
    verdict = find("patrol").grade(Script("patrol.py", PATROL.replace("    client.wait_for_result()\n", "")))
    assert verdict.status is Status.WRONG
    assert "wait_for_result" in str(verdict)
